#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/mean_curvature_flow.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/benchmark/benchmark_command.h"
#include "samples/benchmark/grid_cell.h"
#include "samples/benchmark/grid_report.h"
#include "samples/benchmark/loosest_tolerance.h"
#include "samples/benchmark/matrix_market.h"
#include "samples/benchmark/memory_bandwidth.h"
#include "samples/benchmark/methods/peer_solver.h"
#include "samples/benchmark/run_method.h"
#include "samples/benchmark/scratch_folder.h"
#include "samples/benchmark/whole_run.h"
#include "samples/meshes/meshes.h"
#include "tests/support/relative.h"
#include "tests/support/sanitizers.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

constexpr std::array laplacians{Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::PtackovaVelho};

MethodTask task_of(Method method, const PolygonMesh& mesh, Laplacian laplacian, double tolerance = 0.0)
{
    MethodTask task{method, {}, tolerance, {}};
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

/// A Matrix Market file of any kind as a dense or sparse matrix.
Eigen::SparseMatrix<double> read_matrix_market(const std::filesystem::path& path)
{
    std::ifstream file(path);
    std::string banner;
    std::getline(file, banner);
    const bool array = banner.find(" array ") != std::string::npos;
    int rows = 0;
    int columns = 0;
    file >> rows >> columns;
    int n = array ? rows * columns : 0;
    if (!array)
        file >> n;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
        int row = i % rows + 1;
        int column = i / rows + 1;
        double value = 0.0;
        if (!array)
            file >> row >> column;
        file >> value;
        entries.emplace_back(row - 1, column - 1, value);
        if (banner.ends_with("symmetric") && row != column)
            entries.emplace_back(column - 1, row - 1, value);
    }
    REQUIRE(file.good());
    Eigen::SparseMatrix<double> matrix(rows, columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
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

TEST_CASE("direct solvers take the steps of the undecomposed flow")
{
    for (const char* kind : {"triangles", "mixed", "noisy-sphere"})
        for (const Laplacian laplacian : laplacians) {
            CAPTURE(kind);
            CAPTURE(name_of(laplacian));
            const PolygonMesh mesh = make_mesh(kind, 1'000);
            CHECK(distance(Method::Umfpack, mesh, laplacian) < 1e-9);
            if (laplacian != Laplacian::PtackovaVelho)
                CHECK(distance(Method::Cholmod, mesh, laplacian) < 1e-9);
        }
}

TEST_CASE("iterative solvers come as near to it as their tolerance lets them")
{
    const PolygonMesh mesh = make_mesh("mixed", 1'000);
    for (const Laplacian laplacian : laplacians)
        for (const Method method : {Method::Krylov, Method::KrylovIncomplete}) {
            CAPTURE(name_of(laplacian));
            const double tight = distance(method, mesh, laplacian, 1e-10);
            CHECK(tight < 1e-6);
            CHECK(distance(method, mesh, laplacian, 1e-3) > tight);
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
                MethodTask task = task_of(Method::Undecomposed, mesh, laplacian, 1e-11);
                task.options.resources.threads = threads;
                const Points exact = run_method(mesh, task).positions;
                task.method = Method::Krylov;
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
    const auto run = [&](Method method) {
        MethodTask task = task_of(method, mesh, Laplacian::Fujiwara);
        task.options.cut.subdomains = 0;
        return run_method(mesh, task);
    };
    const Points exact = run(Method::Undecomposed).positions;
    const auto distance_of = [&](const MethodResult& result) {
        return vertex_distance(mesh, exact, result.positions).max / mean_edge_length(mesh);
    };
    const MethodResult sweep = run(Method::OurSweep);
    const MethodResult converged = run(Method::OurConverged);
    const MethodResult cg = run(Method::OurCg);
    CHECK(sweep.approach == "sweep");
    CHECK(converged.approach == "converged");
    CHECK(cg.approach == "cg");
    CHECK(run(Method::Undecomposed).approach == "undecomposed");
    CHECK(sweep.iterations == 0);
    CHECK(converged.iterations > 0);
    CHECK(cg.iterations > converged.iterations);
    CHECK(distance_of(sweep) > distance_of(converged));
    CHECK(distance_of(sweep) > distance_of(cg));
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

TEST_CASE("smooth_shape takes the step of Alexa-Wardetzky on triangles, and no other")
{
    const PolygonMesh mesh = make_mesh("triangles", 1'000);
    CHECK(distance(Method::SmoothShape, mesh, Laplacian::AlexaWardetzky) < 1e-6);
    CHECK(run_method(mesh, task_of(Method::SmoothShape, mesh, Laplacian::Fujiwara)).positions.rows() == 0);
    // Without fixed vertices it scales the mesh.
    const PolygonMesh sphere = make_mesh("noisy-sphere", 1'000);
    CHECK(run_method(sphere, task_of(Method::SmoothShape, sphere, Laplacian::AlexaWardetzky)).positions.rows() == 0);
    const PolygonMesh quads = make_mesh("quads", 1'000);
    CHECK_THROWS_AS(run_method(quads, task_of(Method::SmoothShape, quads, Laplacian::AlexaWardetzky)),
                    ComputationError);
}

TEST_CASE("the symmetric form is symmetric, and stored by rows it is the same matrix")
{
    const PolygonMesh mesh = make_mesh("mixed", 500);
    const Topology topology = make_topology(mesh);
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky}) {
        WholeSystem by_columns(mesh, topology, laplacian, SystemForm::Symmetric, StorageOrder::ByColumns);
        WholeSystem by_rows(mesh, topology, laplacian, SystemForm::Symmetric, StorageOrder::ByRows);
        by_columns.assemble(mesh.vertices, 0.01);
        by_rows.assemble(mesh.vertices, 0.01);
        REQUIRE(by_columns.n() < mesh.n_vertices());
        REQUIRE(by_columns.pattern().rows == by_rows.pattern().rows);
        for (std::size_t i = 0; i < by_columns.values().size(); ++i)
            CHECK(by_columns.values()[i] == test::relative(by_rows.values()[i], 1e-12));
        CHECK(by_columns.right_hand_side() == by_rows.right_hand_side());
    }
}

TEST_CASE("exported equations read back and solve to the first step, in both forms")
{
    const test::TemporaryDirectory folder;
    const PolygonMesh mesh = make_mesh("mixed", 500);
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky}) {
        MethodTask task = task_of(Method::Umfpack, mesh, laplacian);
        task.options.steps = 1;
        const Points expected = run_method(mesh, task).positions;
        export_first_step(folder.path(), mesh, task.options);

        Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(read_matrix_market(folder / "system.mtx"));
        const Eigen::MatrixXd solved = lu.solve(Eigen::MatrixXd(read_matrix_market(folder / "system_rhs.mtx")));
        CHECK((solved - expected).cwiseAbs().maxCoeff() < 1e-12);

        const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky(read_matrix_market(folder / "symmetric.mtx"));
        REQUIRE(cholesky.info() == Eigen::Success);
        const Eigen::MatrixXd unknowns =
            cholesky.solve(Eigen::MatrixXd(read_matrix_market(folder / "symmetric_rhs.mtx")));
        const Eigen::MatrixXd vertices = read_matrix_market(folder / "symmetric_vertices.mtx");
        Eigen::MatrixXd moved = read_matrix_market(folder / "positions.mtx");
        for (Eigen::Index u = 0; u < unknowns.rows(); ++u)
            moved.row(static_cast<Eigen::Index>(vertices(u, 0)) - 1) = unknowns.row(u);
        CHECK((moved - expected).cwiseAbs().maxCoeff() < 1e-12);
    }
}

TEST_CASE("what processes hand to each other arrives as it was")
{
    const ScratchFolder folder;
    const PolygonMesh mesh = make_mesh("mixed", 200);
    write_mesh_for_methods(folder.path(), mesh);
    const PolygonMesh read = read_mesh_for_methods(folder.path());
    CHECK(read.vertices == mesh.vertices);
    CHECK(read.face_offsets == mesh.face_offsets);
    CHECK(read.face_vertices == mesh.face_vertices);

    MethodTask task = task_of(Method::Amg, mesh, Laplacian::AlexaWardetzky, 1e-4);
    task.options.interface.conditions = Conditions::Ventcell;
    task.options.interface.q = 0.25;
    task.options.resources.memory_limit = std::size_t{1} << 40;
    task.simulated_threads = {1, 1024};
    task.options.resources.tune_for = 16;
    task.input = "in.obj";
    task.output = "out.ply";
    write_task(folder.path(), task);
    const MethodTask task_read = read_task(folder.path());
    CHECK(task_read.method == task.method);
    CHECK(task_read.tolerance == task.tolerance);
    CHECK(task_read.options.laplacian == task.options.laplacian);
    CHECK(task_read.options.interface.conditions == task.options.interface.conditions);
    CHECK(task_read.options.interface.q == task.options.interface.q);
    CHECK(task_read.options.resources.memory_limit == task.options.resources.memory_limit);
    CHECK(task_read.simulated_threads == task.simulated_threads);
    CHECK(task_read.options.resources.tune_for == 16);
    CHECK(task_read.input == task.input);
    CHECK(task_read.output == task.output);
    CHECK(task_read.options.time_step == task.options.time_step);
    CHECK(task_read.options.steps == task.options.steps);

    MethodResult result = run_method(mesh, task_of(Method::Cholmod, mesh, Laplacian::Fujiwara));
    result.remarks = {"a remark"};
    result.simulations = {
        {.workers = 3, .work = 2.0, .makespan = 1.0, .critical_path_seconds = 0.1, .critical_path = {4, 2}}};
    write_result(folder.path(), result);
    const MethodResult result_read = read_result(folder.path());
    CHECK(result_read.positions == result.positions);
    CHECK(result_read.step_seconds() == result.step_seconds());
    CHECK(result_read.total_seconds() == result.total_seconds());
    CHECK(result_read.remarks == result.remarks);
    REQUIRE(result_read.simulations.size() == 1);
    CHECK(result_read.simulations[0].workers == 3);
    CHECK(result_read.simulations[0].speed_up() == 2.0);
    CHECK(result_read.simulations[0].critical_path == std::vector<Index>{4, 2});
    task.options.interface.q.reset();
    task.options.resources.memory_limit.reset();
    write_task(folder.path(), task);
    CHECK_FALSE(read_task(folder.path()).options.interface.q);
    CHECK_FALSE(read_task(folder.path()).options.resources.memory_limit);
}

TEST_CASE("iterations and their accuracy do not depend on where the mesh lies")
{
    const PolygonMesh here = make_mesh("mixed", 1'000);
    PolygonMesh far = here;
    far.vertices.rowwise() += Point(1024.0, -512.0, 2048.0);
    const MethodTask task = task_of(Method::Krylov, here, Laplacian::Fujiwara, 1e-4);
    const MethodResult near_result = run_method(here, task);
    const MethodResult far_result = run_method(far, task);
    CHECK(near_result.iterations > 6);
    CHECK(far_result.iterations == near_result.iterations);
    const Points back = far_result.positions.rowwise() - Point(1024.0, -512.0, 2048.0);
    CHECK((back - near_result.positions).cwiseAbs().maxCoeff() < 1e-7);
}

TEST_CASE("a step of ours is replayed with each number of threads that is asked for")
{
    const PolygonMesh mesh = make_mesh("mixed", 3'000);
    MethodTask task = task_of(Method::Ours, mesh, Laplacian::Fujiwara);
    task.options.cut.subdomains = 20;
    task.simulated_threads = {1, 4, 1024};
    const MethodResult result = run_method(mesh, task);
    REQUIRE(result.simulations.size() == 3);
    CHECK(result.simulations[0].speed_up() == test::relative(1.0, 1e-5));
    CHECK(result.simulations[1].speed_up() > 1.0);
    CHECK(result.simulations[2].makespan <= result.simulations[1].makespan);
    CHECK(result.simulations[2].workers == 1024);
    task.simulated_threads.clear();
    CHECK(run_method(mesh, task).simulations.empty());
}

TEST_CASE("numbers of threads go by lists")
{
    CHECK(numbers_named("all", "--simulate-threads") == std::vector{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024});
    CHECK(numbers_named("3", "--simulate-threads") == std::vector{3});
    CHECK(numbers_named("8,1,8", "--simulate-threads") == std::vector{8, 1, 8});
    for (const char* word : {"", "0", "1,", ",1", "1025", "-1", "1.5", "1 2", "all,1", "many"})
        CHECK_THROWS_AS(numbers_named(word, "--simulate-threads"), OptionError);
}

TEST_CASE("a simulation records with one thread and without a limit, where nothing else is said")
{
    BenchmarkCommand command;
    REQUIRE_FALSE(parse({"--simulate-threads", "1,16"}, command));
    CHECK(command.mode == BenchmarkMode::SimulateThreads);
    CHECK(command.options.simulated_threads == std::vector{1, 16});
    CHECK(command.options.flow.resources.threads == 1);
    CHECK(command.options.flow.resources.memory_limit == std::numeric_limits<std::size_t>::max());
    CHECK(command.options.peers.empty());
    CHECK(command.options.reference == Reference::None);
    CHECK(command.memory_bandwidth == 0.0);
    BenchmarkCommand refined;
    REQUIRE_FALSE(parse({"--simulate-threads", "all", "--threads", "2", "--memory-limit", "2G", "--conditions",
                         "ventcell", "--q", "0.1", "--memory-bandwidth", "137"},
                        refined));
    CHECK(refined.memory_bandwidth == 137.0);
    CHECK(refined.options.flow.resources.threads == 2);
    CHECK(refined.options.flow.resources.memory_limit == 2'000'000'000);
    CHECK(refined.options.flow.interface.conditions == Conditions::Ventcell);
    CHECK(refined.options.flow.interface.q == 0.1);
}

TEST_CASE("the time of a step is the median of those after the first")
{
    MethodResult result;
    for (const double total : {100.0, 3.0, 1.0, 2.0})
        result.steps.push_back({.total = total});
    result.setup_seconds = 4.0;
    CHECK(result.step_seconds() == 2.0);
    CHECK(result.total_seconds() == 110.0);
    result.steps.resize(1);
    CHECK(result.step_seconds() == 100.0);
}

TEST_CASE("turns have a least and a median")
{
    const Turns turns{{4.0, 1.0, 3.0, 2.0, 9.0}};
    CHECK(turns.least() == 1.0);
    CHECK(turns.median() == 3.0);
}

TEST_CASE("the loosest tolerance that suffices is found with few questions")
{
    for (const double limit : tolerance_ladder) {
        int questions = 0;
        const auto found = loosest_tolerance([&](double tolerance) {
            ++questions;
            return tolerance <= limit;
        });
        CHECK(found == limit);
        CHECK(questions <= 6);
    }
    CHECK_FALSE(loosest_tolerance([](double) { return false; }));
}

TEST_CASE("the fastest peer of a cell is one that comes as near as ours")
{
    const auto row = [](double seconds, double v_max, double v_mean) {
        Row made{"", {}, {}, v_mean, v_max, {}};
        made.turns.seconds = {seconds, 0.5 * seconds, 9.0};
        return made;
    };
    GridCell cell;
    cell.ours = row(2.0, 0.1, 0.01);
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
                cell.ours.turns.seconds = {1.0};
                cell.ours.v_mean = cell.ours.v_max = 0.1;
                cell.peers = {cell.ours};
                cell.peers[0].name = "other";
                cell.peers[0].turns.seconds = {steps * time_step_edges / 2.0};
            }
    cells[3].peers.clear();
    cells[6].ours.result.error = "no";
    cells[6].peers.clear();
    std::ostringstream out;
    print_grid_summary(out, cells);
    CHECK(out.str().find("\n| mesh | vertices | dt 1 | dt 50 |\n| quads | 100 | 0.50, 1.50 | 25.00, – |\n"
                         "| scan.ply | 100 | 0.50, 1.50 | failed, 75.00 |\n") != std::string::npos);
    CHECK(out.str().find("ours is not the fastest in 2 of 8 cells\n"
                         "  quads, 100 vertices, dt 1, steps 1: other takes 0.50 of the time of") != std::string::npos);
}

TEST_CASE("peers go by names")
{
    CHECK(peers_named("none").empty());
    CHECK(peers_named("all").size() == 6);
    CHECK(peers_named("cg,cholmod,cg") == std::vector{Method::Cholmod, Method::Krylov});
    CHECK(peers_named("our-cg,undecomposed,cholmod") ==
          std::vector{Method::Cholmod, Method::OurCg, Method::Undecomposed});
    for (const char* word : {"", "cg,", ",cg", "CG", "cg cholmod", "all,cg"})
        CHECK_THROWS_AS(peers_named(word), OptionError);
}

TEST_CASE("where threads that measure the bandwidth of memory cannot start, that is said, and none waits for them")
{
    if (test::under_sanitizers)
        return;
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        // Room for the vectors, but not for the stacks of so many threads.
        constexpr rlim_t more = 3 * (std::size_t{128} << 20U) + (std::size_t{48} << 20U);
        std::ifstream file("/proc/self/statm");
        rlim_t pages = 0;
        file >> pages;
        const rlim_t most = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more;
        const rlimit limit{most, most};
        alarm(60);
        if (setrlimit(RLIMIT_AS, &limit) != 0)
            _exit(2);
        try {
            triad_bandwidth(200);
        } catch (const ComputationError& error) {
            _exit(std::string(error.what()).starts_with("cannot start 200 threads") ? 0 : 1);
        }
        _exit(3);
    }
    int status = -1;
    REQUIRE(waitpid(child, &status, 0) == child);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    CHECK(triad_bandwidth(2) > 1e8);
}

TEST_CASE("the command line of benchmark has defaults that fit the mode")
{
    BenchmarkCommand command;
    REQUIRE_FALSE(parse({}, command));
    CHECK(command.options.peers.size() == 6);
    CHECK(command.options.flow.steps == 5);
    CHECK(command.options.flow.resources.threads >= 1);
    CHECK(command.options.reference == Reference::Automatic);
    BenchmarkCommand scaling;
    REQUIRE_FALSE(parse({"--scaling"}, scaling));
    CHECK(scaling.options.peers.empty());
    CHECK(scaling.vertices == 10'000'000);
    CHECK(scaling.options.reference == Reference::None);
    BenchmarkCommand with_peers;
    REQUIRE_FALSE(parse({"--scaling", "--peers", "amg", "--vertices", "20000"}, with_peers));
    CHECK(with_peers.options.peers == std::vector{Method::Amg});
    CHECK(with_peers.vertices == 20'000);
    CHECK(with_peers.options.reference == Reference::Automatic);
    BenchmarkCommand grid;
    REQUIRE_FALSE(parse({"--grid"}, grid));
    CHECK(grid.mode == BenchmarkMode::Grid);
    CHECK(grid.options.peers == std::vector{Method::Cholmod, Method::Krylov, Method::Amg});
    CHECK(grid.options.reference == Reference::Automatic);
    CHECK(grid.grid.kinds.size() == 4);
    CHECK(grid.grid.files.empty());
    CHECK(grid.grid.steps == std::vector{1, 3, 10});
    CHECK(grid.vertices == 100'000);
    BenchmarkCommand row_of_grid;
    REQUIRE_FALSE(
        parse({"--grid", "a.ply", "b.ply", "--kind", "quads", "--steps", "2", "--time-step-edges", "7"}, row_of_grid));
    CHECK(row_of_grid.grid.files.size() == 2);
    CHECK(row_of_grid.grid.kinds == std::vector<std::string>{"quads"});
    CHECK(row_of_grid.grid.steps == std::vector{2});
    CHECK(row_of_grid.grid.time_steps_edges == std::vector{7.0});
    BenchmarkCommand whole;
    REQUIRE_FALSE(parse({"--whole-run"}, whole));
    CHECK(whole.mode == BenchmarkMode::WholeRun);
    CHECK(whole.options.peers == std::vector{Method::Cholmod, Method::Krylov});
    CHECK(whole.options.reference == Reference::Automatic);
    BenchmarkCommand whole_scaling;
    REQUIRE_FALSE(parse({"--scaling", "--whole-run"}, whole_scaling));
    CHECK(whole_scaling.mode == BenchmarkMode::WholeRunScaling);
    CHECK(whole_scaling.options.peers.empty());
    CHECK(whole_scaling.vertices == 10'000'000);
    BenchmarkCommand ignored;
    CHECK_THROWS_AS(parse({"--scaling", "--vertices", "500"}, ignored), OptionError);
}
