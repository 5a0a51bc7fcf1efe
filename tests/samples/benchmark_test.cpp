#include <cmath>
#include <sstream>

#include <Eigen/SparseCore>
#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/benchmark/benchmark_command.h"
#include "samples/benchmark/grid_cell.h"
#include "samples/benchmark/methods/peer_solver.h"
#include "samples/benchmark/run_method.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

constexpr std::array laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement};

MethodTask task_of(Method method, const PolygonMesh& mesh, Laplacian laplacian, double tolerance = 0.0)
{
    MethodTask task{method, {}, tolerance};
    task.options.laplacian = laplacian;
    const double edge = mean_edge_length(mesh);
    task.options.time_step = 5.0 * edge * edge;
    task.options.steps = 2;
    task.options.cut.subdomains = 1;
    task.options.resources.threads = 2;
    return task;
}

/// Largest distance to the undecomposed flow of the library, in mean edge lengths.
double distance(Method method, const PolygonMesh& mesh, Laplacian laplacian, double tolerance = 0.0)
{
    PolygonMesh undecomposed = mesh;
    mean_curvature_flow(undecomposed, task_of(Method::Ours, mesh, laplacian).options);
    const MethodResult result = run_method(mesh, task_of(method, mesh, laplacian, tolerance));
    CHECK(result.steps.size() == 2);
    const VertexDistance d = vertex_distance(mesh, undecomposed.vertices, result.positions);
    return d.max / d.mean_edge;
}

std::optional<ExitStatus> parse(std::vector<std::string> words, BenchmarkCommand& command)
{
    words.insert(words.begin(), "benchmark");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    return parse_benchmark_command(static_cast<int>(arguments.size()), arguments.data(), command);
}

}  // namespace

TEST_CASE("CHOLMOD takes the steps of the undecomposed flow")
{
    for (const char* kind : {"triangles", "mixed", "noisy-sphere"})
        for (const Laplacian laplacian : laplacians) {
            CAPTURE(kind);
            CAPTURE(name_of(laplacian));
            CHECK(distance(Method::Cholmod, make_mesh(kind, 1'000), laplacian) < 1e-9);
        }
}

TEST_CASE("conjugate gradients come as near to it as their tolerance lets them")
{
    const PolygonMesh mesh = make_mesh("mixed", 1'000);
    for (const Laplacian laplacian : laplacians) {
        CAPTURE(name_of(laplacian));
        const double tight = distance(Method::Gradients, mesh, laplacian, 1e-10);
        CHECK(tight < 1e-6);
        CHECK(distance(Method::Gradients, mesh, laplacian, 1e-3) > tight);
    }
}

TEST_CASE("conjugate gradients in single precision reach what is asked, with any number of threads and in any unit")
{
    PolygonMesh mesh = make_mesh("noisy-sphere", 3'000);
    for (const double unit : {1.0, 1e-5})
        for (const int threads : {1, 3}) {
            CAPTURE(unit);
            CAPTURE(threads);
            mesh.vertices *= unit;
            for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky}) {
                MethodTask task = task_of(Method::Ours, mesh, laplacian, 1e-11);
                task.options.accuracy.approach = Approach::Undecomposed;
                task.options.resources.threads = threads;
                const Points exact = run_method(mesh, task).positions;
                task.method = Method::Gradients;
                const MethodResult result = run_method(mesh, task);
                CHECK(vertex_distance(mesh, exact, result.positions).max < 1e-8 * mean_edge_length(mesh));
                task.tolerance = 1e-5;
                CHECK(run_method(mesh, task).iterations < result.iterations);
            }
            mesh.vertices /= unit;
        }
}

TEST_CASE("ours takes its steps by the approach that is named")
{
    const PolygonMesh mesh = make_mesh("triangles", 20'000);
    const auto run = [&](Approach approach) {
        MethodTask task = task_of(Method::Ours, mesh, Laplacian::Fujiwara);
        task.options.cut.subdomains = 0;
        task.options.accuracy.approach = approach;
        return run_method(mesh, task);
    };
    CHECK(run(Approach::Sweep).approach == "sweep");
    CHECK(run(Approach::Sweep).iterations == 0);
    CHECK(run(Approach::Undecomposed).approach == "undecomposed");
    const MethodResult gradients = run(Approach::ConjugateGradients);
    CHECK(gradients.approach == "cg");
    CHECK(gradients.iterations > 0);
}

TEST_CASE("algebraic multigrid, where it is built in")
{
    const PolygonMesh mesh = make_mesh("mixed", 1'000);
    if (!has_amg()) {
        MESSAGE("amg is not built in: install libhypre-dev");
        CHECK_THROWS_WITH_AS(run_method(mesh, task_of(Method::Amg, mesh, Laplacian::Fujiwara, 1e-8)),
                             "not built in: install libhypre-dev", ComputationError);
        return;
    }
    CHECK(distance(Method::Amg, mesh, Laplacian::Fujiwara, 1e-8) < 1e-6);
}

TEST_CASE("the equations are symmetric")
{
    const PolygonMesh mesh = make_mesh("mixed", 500);
    const Topology topology = make_topology(mesh);
    for (const Laplacian laplacian : laplacians) {
        CAPTURE(name_of(laplacian));
        WholeSystem system(mesh, topology, laplacian);
        system.assemble(mesh.vertices, 0.01);
        REQUIRE(system.n() < mesh.n_vertices());
        const SparsePattern& pattern = system.pattern();
        const Eigen::SparseMatrix<double> matrix = Eigen::Map<const Eigen::SparseMatrix<double>>(
            system.n(), system.n(), pattern.n_entries(), pattern.column_offsets.data(), pattern.rows.data(),
            system.values().data());
        const Eigen::SparseMatrix<double> transposed = matrix.transpose();
        CHECK((matrix - transposed).norm() < 1e-14 * matrix.norm());
    }
}

TEST_CASE("the task that a process is given arrives as it was")
{
    const test::TemporaryDirectory folder;
    const auto sent = [&](const MethodTask& of) {
        write_archive(folder / "task", "task\n", of);
        return read_archive<MethodTask>(folder / "task", "task\n");
    };
    MethodTask task = task_of(Method::Amg, make_mesh("mixed", 200), Laplacian::AlexaWardetzky, 1e-4);
    task.options.accuracy.approach = Approach::Converged;
    task.options.accuracy.tolerance = 1e-5;
    task.options.resources.memory_limit = std::size_t{1} << 40;
    task.options.resources.tune_for = 16;
    task.input = "in.obj";
    task.output = "out.ply";
    const MethodTask task_read = sent(task);
    CHECK(task_read.method == task.method);
    CHECK(task_read.tolerance == task.tolerance);
    CHECK(task_read.options.laplacian == task.options.laplacian);
    CHECK(task_read.options.accuracy.approach == task.options.accuracy.approach);
    CHECK(task_read.options.accuracy.tolerance == task.options.accuracy.tolerance);
    CHECK(task_read.options.resources.memory_limit == task.options.resources.memory_limit);
    CHECK(task_read.options.resources.threads == 2);
    CHECK(task_read.options.resources.tune_for == 16);
    CHECK(task_read.options.cut.subdomains == 1);
    CHECK(task_read.options.time_step == task.options.time_step);
    CHECK(task_read.options.steps == task.options.steps);
    CHECK(task_read.input == task.input);
    CHECK(task_read.output == task.output);
    task.options.accuracy.tolerance.reset();
    task.options.resources.memory_limit.reset();
    CHECK_FALSE(sent(task).options.accuracy.tolerance);
    CHECK_FALSE(sent(task).options.resources.memory_limit);
}

TEST_CASE("iterations and their accuracy do not depend on where the mesh lies")
{
    const PolygonMesh here = make_mesh("mixed", 1'000);
    PolygonMesh far = here;
    far.vertices.rowwise() += Point(1024.0, -512.0, 2048.0);
    const MethodTask task = task_of(Method::Gradients, here, Laplacian::Fujiwara, 1e-4);
    const MethodResult near_result = run_method(here, task);
    const MethodResult far_result = run_method(far, task);
    CHECK(near_result.iterations > 6);
    CHECK(far_result.iterations == near_result.iterations);
    const Points back = far_result.positions.rowwise() - Point(1024.0, -512.0, 2048.0);
    CHECK((back - near_result.positions).cwiseAbs().maxCoeff() < 1e-7);
}

TEST_CASE("the time of a step is the median of those after the first")
{
    MethodResult result;
    result.steps = {100.0, 3.0, 1.0, 2.0};
    result.setup_seconds = 4.0;
    CHECK(result.step_seconds() == 2.0);
    CHECK(result.total_seconds() == 110.0);
    result.steps.resize(1);
    CHECK(result.step_seconds() == 100.0);
    CHECK(MethodResult{}.step_seconds() == 0.0);
}

TEST_CASE("a row of a table has what its columns show, and a failure behind the name")
{
    std::ostringstream out;
    Table table(out, {{"method", "method", 7}, {"seconds", "seconds", 8}, {"n", "n", 6}, {"chosen", "", 1}});
    table.add({{"method", "ours"}, {"seconds", 0.123456}, {"n", 123456}, {"chosen", true}, {"more", 1}});
    table.add({{"method", "cg"}, {"n", 2}});
    table.add({{"method", "cholmod"}, {"error", "out of memory"}, {"n", 2}});
    CHECK(out.str() == "method  seconds  n        \n"
                       "ours    0.123    123456 * \n"
                       "cg               2        \n"
                       "cholmod out of memory\n");
    REQUIRE(table.rows().size() == 3);
    CHECK(table.rows()[0]["more"] == 1);
}

TEST_CASE("the fastest peer of a cell is one that comes as near as ours")
{
    const auto row = [](double seconds, double v_max, double v_mean) {
        Row made{{}, {}, v_mean, v_max, {}};
        made.turns = {seconds, 0.5 * seconds, 9.0};
        return made;
    };
    GridCell cell;
    cell.ours = row(2.0, 0.1, 0.01);
    CHECK(cell.ours.seconds() == 2.0);
    CHECK(cell.fastest_peer() == nullptr);
    CHECK(std::isinf(cell.ratio()));
    cell.peers = {row(1.0, 0.11, 0.01), row(1.1, 0.1, 0.011), row(4.0, 0.1, 0.01), row(3.0, 0.0, 0.0),
                  row(0.5, 0.0, 0.0)};
    cell.peers.back().result.error = "slower";
    CHECK(cell.fastest_peer() == &cell.peers[3]);
    CHECK(cell.ratio() == 1.5);
    // Where ours is exact, what is nearly so is as near.
    cell.ours = row(2.0, 1e-12, 1e-13);
    cell.peers = {row(1.0, 1.1e-3, 0.0), row(1.0, 0.0, 1.1e-4), row(3.0, 0.9e-3, 0.9e-4)};
    CHECK(cell.fastest_peer() == &cell.peers[2]);
}

TEST_CASE("a grid ends with the ratios of all cells and with those that are lost")
{
    std::vector<GridCell> cells;
    for (const char* mesh : {"quads", "scan.ply"})
        for (const double time_step_edges : {1.0, 50.0})
            for (const int steps : {1, 3}) {
                GridCell& cell = cells.emplace_back();
                cell.mesh = mesh;
                cell.vertices = 100;
                cell.time_step_edges = time_step_edges;
                cell.steps = steps;
                cell.ours.turns = {1.0};
                cell.ours.v_mean = cell.ours.v_max = 0.1;
                cell.peers = {cell.ours};
                cell.peers[0].task.method = Method::Cholmod;
                cell.peers[0].turns = {steps * time_step_edges / 2.0};
            }
    cells[3].peers.clear();
    cells[6].ours.result.error = "no";
    cells[6].peers.clear();
    std::ostringstream out;
    print_grid_summary(out, cells);
    CHECK(out.str().find("\n| mesh | vertices | dt 1 | dt 50 |\n| quads | 100 | 0.50, 1.50 | 25.00, – |\n"
                         "| scan.ply | 100 | 0.50, 1.50 | failed, 75.00 |\n") != std::string::npos);
    CHECK(out.str().find("ours is not the fastest in 2 of 8 cells\n"
                         "  quads, 100 vertices, dt 1, steps 1: cholmod takes 0.50 of the time of ours\n") !=
          std::string::npos);
}

TEST_CASE("peers go by names")
{
    CHECK(peers_named("none").empty());
    CHECK(peers_named("all").size() == 3);
    CHECK(peers_named("cg,cholmod,cg") == std::vector{Method::Cholmod, Method::Gradients});
    for (const char* word : {"", "cg,", ",cg", "CG", "cg cholmod", "all,cg", "ours"})
        CHECK_THROWS_AS(peers_named(word), OptionError);
}

TEST_CASE("the command line of benchmark has defaults that fit the mode")
{
    BenchmarkCommand command;
    REQUIRE_FALSE(parse({}, command));
    CHECK(command.mode == BenchmarkMode::Cell);
    CHECK(command.peers.size() == 3);
    CHECK(command.steps == std::vector{5});
    CHECK(command.turns == 1);
    CHECK(command.flow.resources.threads >= 1);
    BenchmarkCommand read;
    REQUIRE_FALSE(parse({"--mesh", "a.ply", "--steps", "2", "--time-step-edges", "7"}, read));
    CHECK(read.kinds.empty());
    CHECK(read.files == std::vector<std::filesystem::path>{"a.ply"});
    CHECK(read.steps == std::vector{2});
    CHECK(read.time_steps_edges == std::vector{7.0});
    BenchmarkCommand grid;
    REQUIRE_FALSE(parse({"--grid"}, grid));
    CHECK(grid.mode == BenchmarkMode::Grid);
    CHECK(grid.kinds.size() == 4);
    CHECK(grid.files.empty());
    CHECK(grid.steps == std::vector{1, 3, 10});
    CHECK(grid.time_steps_edges.size() == 4);
    CHECK(grid.vertices == 100'000);
    CHECK(grid.turns == 3);
    BenchmarkCommand row_of_grid;
    REQUIRE_FALSE(
        parse({"--grid", "a.ply", "b.ply", "--kind", "quads", "--steps", "2", "--time-step-edges", "7"}, row_of_grid));
    CHECK(row_of_grid.files.size() == 2);
    CHECK(row_of_grid.kinds == std::vector<std::string>{"quads"});
    CHECK(row_of_grid.steps == std::vector{2});
    CHECK(row_of_grid.time_steps_edges == std::vector{7.0});
    BenchmarkCommand whole;
    REQUIRE_FALSE(parse({"--whole-run"}, whole));
    CHECK(whole.mode == BenchmarkMode::WholeRun);
    CHECK(whole.peers == std::vector{Method::Cholmod, Method::Gradients});
    BenchmarkCommand k_harmonic;
    REQUIRE_FALSE(parse({"--k-harmonic", "2,1"}, k_harmonic));
    CHECK(k_harmonic.orders == std::vector{2, 1});
    CHECK(k_harmonic.flow.laplacian == Laplacian::AlexaWardetzky);
}
