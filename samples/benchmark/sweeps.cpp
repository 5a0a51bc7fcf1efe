#include "samples/benchmark/sweeps.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/benchmark/case_json.h"
#include "samples/benchmark/case_text.h"
#include "samples/benchmark/explanation.h"
#include "samples/benchmark/grid_cell.h"
#include "samples/benchmark/grid_report.h"
#include "samples/benchmark/k_harmonic.h"
#include "samples/benchmark/many_cores.h"
#include "samples/benchmark/matrix_market.h"
#include "samples/benchmark/simulated_ranks.h"
#include "samples/benchmark/whole_run.h"
#include "samples/files/mesh_results.h"
#include "samples/meshes/meshes.h"
#include "samples/report/report_text.h"
#include "solvers/laplacian/degenerate.h"

namespace seamflow {

namespace {

using Json = nlohmann::ordered_json;

PolygonMesh load(const BenchmarkCommand& command, Index vertices)
{
    if (command.mesh.empty())
        return make_mesh(command.kind, vertices);
    try {
        PolygonMesh mesh = read_mesh(command.mesh).mesh;
        require_faces(command.mesh, mesh.n_faces());
        require_sound_geometry(mesh, make_topology(mesh), command.options.flow.laplacian);
        return mesh;
    } catch (const InputError& error) {
        const std::string name = command.mesh.string();
        const std::string message = error.what();
        throw InputError(message.starts_with(name) ? message : name + ": " + message);
    }
}

std::string name_of_mesh(const BenchmarkCommand& command)
{
    return command.mesh.empty() ? command.kind : command.mesh.string();
}

/// The options of a case with the time step that belongs to its mesh.
CaseOptions options_for(const BenchmarkCommand& command, const PolygonMesh& mesh)
{
    CaseOptions options = command.options;
    const double edge = mean_edge_length(mesh);
    if (edge <= 0.0)
        throw InputError(name_of_mesh(command) + ": has no edges of any length to measure --time-step-edges by");
    options.flow.time_step = command.time_step_edges * edge * edge;
    return options;
}

/// One case with its table.
CaseResult run_table(const BenchmarkCommand& command, const PolygonMesh& mesh, const CaseOptions& options,
                     std::ostream& out)
{
    CaseTable table(out, name_of_mesh(command), mesh.n_vertices(), command.time_step_edges, options);
    CaseResult result = run_case(mesh, options, [&](const Row& row) { table.print(row); });
    table.finish(result);
    return result;
}

Json run_one(const BenchmarkCommand& command, std::ostream& out)
{
    const PolygonMesh mesh = load(command, command.vertices);
    const CaseOptions options = options_for(command, mesh);
    if (!command.export_folder.empty())
        export_first_step(command.export_folder, mesh, options.flow);
    const CaseResult result = run_table(command, mesh, options, out);
    return case_json(name_of_mesh(command), command.time_step_edges, options, result);
}

template <class... Numbers>
void print_line(std::ostream& out, const char* format, Numbers... numbers)
{
    char text[256];
    std::snprintf(text, sizeof text, format, numbers...);
    out << text << std::endl;
}

/// 10⁴, 10⁵, … vertices.
std::vector<Index> sizes_up_to(Index most)
{
    std::vector<Index> sizes{10'000};
    while (sizes.back() < most)
        sizes.push_back(std::min(10 * sizes.back(), most));
    return sizes;
}

Json run_scaling(const BenchmarkCommand& command, std::ostream& out)
{
    Json list = Json::array();
    std::vector<CaseResult> results;
    for (const Index vertices : sizes_up_to(command.vertices)) {
        const PolygonMesh mesh = load(command, vertices);
        const CaseOptions options = options_for(command, mesh);
        results.push_back(run_table(command, mesh, options, out));
        list.push_back(case_json(name_of_mesh(command), command.time_step_edges, options, results.back()));
    }
    out << "  vertices  sub-meshes   step us/vertex  setup us/vertex     bytes/vertex\n";
    for (const CaseResult& result : results) {
        const auto n = static_cast<double>(result.vertices);
        const MethodResult& ours = result.ours.result;
        print_line(out, "%10d  %10d  %15.3f  %15.3f  %15.0f", result.vertices, ours.subdomains,
                   1e6 * ours.step_seconds() / n, 1e6 * ours.setup_seconds / n,
                   static_cast<double>(ours.peak_memory_bytes) / n);
    }
    return {{"scaling", list}};
}

Json run_simulation(const BenchmarkCommand& command, std::ostream& out)
{
    const PolygonMesh mesh = load(command, command.vertices);
    const CaseOptions options = options_for(command, mesh);
    const CaseResult result = run_table(command, mesh, options, out);
    out << "the tasks of the median step as they were recorded, replayed with other numbers of threads:\n";
    print_simulations(out, result.ours.result.simulations);
    out << std::flush;
    Json json = case_json(name_of_mesh(command), command.time_step_edges, options, result);
    if (is_symmetric(options.flow.laplacian)) {
        const ManyCores many =
            measure_for_many_cores(mesh, options.flow, options.simulated_threads, 1e9 * command.memory_bandwidth);
        print_many_cores(out, many);
        json["approaches"] = many_cores_json(many);
    }
    return json;
}

Json run_k_harmonic_steps(const BenchmarkCommand& command, std::ostream& out)
{
    const PolygonMesh mesh = load(command, command.vertices);
    const FlowOptions flow = options_for(command, mesh).flow;
    out << name_of_mesh(command) << ", " << mesh.n_vertices() << " vertices, " << name_of(flow.laplacian) << ", dt "
        << short_number(command.time_step_edges) << " squared mean edge lengths, " << flow.resources.threads
        << (flow.resources.threads == 1 ? " thread\n" : " threads\n") << std::flush;
    const std::vector<KHarmonicRow> rows = run_k_harmonic(mesh, flow, command.orders);
    print_k_harmonic(out, rows);
    return {{"vertices", mesh.n_vertices()}, {"k_harmonic", k_harmonic_json(rows)}};
}

Json run_ranks(const BenchmarkCommand& command, std::ostream& out)
{
    const PolygonMesh mesh = load(command, command.vertices);
    const SimulatedRanks simulated = simulate_ranks(mesh, options_for(command, mesh).flow, command.simulated_ranks);
    print_simulated_ranks(out, simulated);
    return simulated_ranks_json(simulated);
}

Json run_threads_sweep(const BenchmarkCommand& command, std::ostream& out)
{
    const PolygonMesh mesh = load(command, command.vertices);
    CaseOptions options = options_for(command, mesh);
    Json list = Json::array();
    std::vector<CaseResult> results;
    for (int threads = 1; threads <= command.options.flow.resources.threads; ++threads) {
        options.flow.resources.threads = threads;
        results.push_back(run_table(command, mesh, options, out));
        list.push_back(case_json(name_of_mesh(command), command.time_step_edges, options, results.back()));
    }
    out << "   threads      step s    speed-up  efficiency\n";
    for (std::size_t i = 0; i < results.size(); ++i) {
        const double step = results[i].ours.result.step_seconds();
        const double speed_up = results.front().ours.result.step_seconds() / step;
        print_line(out, "%10zu  %10.4f  %10.2f  %10.2f", i + 1, step, speed_up, speed_up / static_cast<double>(i + 1));
    }
    return {{"threads_sweep", list}};
}

/// The meshes of a grid, as commands that each name one.
std::vector<BenchmarkCommand> meshes_of_grid(const BenchmarkCommand& command)
{
    std::vector<BenchmarkCommand> commands;
    BenchmarkCommand one = command;
    for (const Index vertices : sizes_up_to(command.vertices))
        for (const std::string& kind : command.grid.kinds) {
            one.kind = kind;
            one.vertices = vertices;
            commands.push_back(one);
        }
    for (const std::filesystem::path& file : command.grid.files) {
        one.mesh = file;
        commands.push_back(one);
    }
    return commands;
}

Json run_explanation(const BenchmarkCommand& command, std::ostream& out)
{
    const PolygonMesh mesh = load(command, command.vertices);
    const Explanation explanation = explain(mesh, options_for(command, mesh).flow, command.options.reference);
    print_explanation(out, explanation);
    return explanation_json(explanation);
}

/// Runs one mesh in all formats.
void run_whole_of(const BenchmarkCommand& command, Index vertices, std::ostream& out, std::vector<WholeRun>& runs)
{
    const PolygonMesh mesh = load(command, vertices);
    const FlowOptions flow = options_for(command, mesh).flow;
    const GridOptions options{command.options.peers, command.options.reference, command.turns};
    const std::vector<std::string> formats = command.mesh.empty()
                                                 ? std::vector<std::string>{"obj", "ply"}
                                                 : std::vector{command.mesh.extension().string().substr(1)};
    for (const std::string& format : formats) {
        WholeRun& run =
            runs.emplace_back(run_whole(mesh, command.mesh, format, flow, command.time_step_edges, options));
        run.mesh = name_of_mesh(command);
        print_whole_run(out, run);
    }
}

Json run_whole_runs(const BenchmarkCommand& command, std::ostream& out)
{
    const bool is_scaling = command.mode == BenchmarkMode::WholeRunScaling;
    std::vector<WholeRun> runs;
    for (const Index vertices : is_scaling ? sizes_up_to(command.vertices) : std::vector{command.vertices})
        run_whole_of(command, vertices, out, runs);
    if (is_scaling)
        out << "  vertices  format     us/vertex  bytes/vertex\n";
    Json list = Json::array();
    for (const WholeRun& run : runs) {
        const auto n = static_cast<double>(run.vertices);
        if (is_scaling)
            print_line(out, "%10d  %6s  %12.3f  %12.0f", run.vertices, run.format.c_str(),
                       1e6 * run.smooth.median() / n, static_cast<double>(run.peak_memory_bytes) / n);
        list.push_back(whole_run_json(run));
    }
    return {{"whole_runs", list}};
}

Json run_grid(const BenchmarkCommand& command, std::ostream& out)
{
    const GridOptions options{command.options.peers, command.options.reference, command.turns};
    Json list = Json::array();
    std::vector<GridCell> cells;
    print_grid_head(out);
    for (BenchmarkCommand one : meshes_of_grid(command)) {
        const PolygonMesh mesh = load(one, one.vertices);
        GridRunner runner(mesh, options);
        for (const double time_step_edges : command.grid.time_steps_edges)
            for (const int steps : command.grid.steps) {
                one.time_step_edges = time_step_edges;
                one.options.flow.steps = steps;
                GridCell cell = runner.run(options_for(one, mesh).flow);
                cell.mesh = one.mesh.empty() ? one.kind : one.mesh.filename().string();
                cell.time_step_edges = time_step_edges;
                print_grid_cell(out, cell);
                list.push_back(grid_cell_json(cell));
                cells.push_back(std::move(cell));
            }
    }
    print_grid_summary(out, cells);
    return {{"grid", list}};
}

}  // namespace

Json run_benchmark(const BenchmarkCommand& command, std::ostream& out)
{
    switch (command.mode) {
    case BenchmarkMode::Scaling:
        return run_scaling(command, out);
    case BenchmarkMode::ThreadsSweep:
        return run_threads_sweep(command, out);
    case BenchmarkMode::SimulateThreads:
        return run_simulation(command, out);
    case BenchmarkMode::SimulateRanks:
        return run_ranks(command, out);
    case BenchmarkMode::Grid:
        return run_grid(command, out);
    case BenchmarkMode::KHarmonic:
        return run_k_harmonic_steps(command, out);
    case BenchmarkMode::Explain:
        return run_explanation(command, out);
    case BenchmarkMode::WholeRun:
    case BenchmarkMode::WholeRunScaling:
        return run_whole_runs(command, out);
    case BenchmarkMode::Case:
        break;
    }
    return run_one(command, out);
}

}  // namespace seamflow
