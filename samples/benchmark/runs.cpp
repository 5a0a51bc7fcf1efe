#include "samples/benchmark/runs.h"

#include <algorithm>
#include <ostream>
#include <utility>

#include "partition/errors.h"
#include "partition/formats/mesh_io.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/topology.h"
#include "samples/benchmark/explanation.h"
#include "samples/benchmark/grid_cell.h"
#include "samples/benchmark/k_harmonic.h"
#include "samples/benchmark/whole_run.h"
#include "samples/files/about_file.h"
#include "samples/files/mesh_input.h"
#include "samples/meshes/meshes.h"
#include "solvers/laplacian/degenerate.h"

namespace seamflow {

namespace {

/// One mesh of a command.
struct NamedMesh {
    std::string name;
    /// Empty: it was made.
    std::filesystem::path file;
    PolygonMesh mesh;
};

NamedMesh read_sound_mesh(const std::filesystem::path& file, Laplacian laplacian)
{
    NamedMesh named{file.filename().string(), file, read_mesh(file).mesh};
    require_faces(file, named.mesh.n_faces());
    about_file(file, [&] { require_sound_geometry(named.mesh, make_topology(named.mesh), laplacian); });
    return named;
}

/// Calls visit(mesh) for each mesh of a command: of all sizes and kinds, and read.
template <class Visit>
void for_each_mesh(const BenchmarkCommand& command, Visit&& visit)
{
    std::vector<Index> sizes{command.vertices};
    if (command.mode == BenchmarkMode::Grid)
        for (sizes = {smallest_of_grid}; sizes.back() < command.vertices;)
            sizes.push_back(std::min(10 * sizes.back(), command.vertices));
    for (const Index vertices : sizes)
        for (const std::string& kind : command.kinds)
            visit(NamedMesh{kind, {}, make_mesh(kind, vertices)});
    for (const std::filesystem::path& file : command.files)
        visit(read_sound_mesh(file, command.flow.laplacian));
}

/// Calls visit(flow, dt in squared mean edge lengths) for each time step and number of steps of a command.
template <class Visit>
void for_each_flow(const BenchmarkCommand& command, const NamedMesh& named, Visit&& visit)
{
    const double edge = mean_edge_length(named.mesh);
    if (edge <= 0.0)
        throw InputError(named.name + ": has no edges of any length to measure --time-step-edges by");
    FlowOptions flow = command.flow;
    for (const double time_step_edges : command.time_steps_edges)
        for (const int steps : command.steps) {
            flow.time_step = time_step_edges * edge * edge;
            flow.steps = steps;
            visit(flow, time_step_edges);
        }
}

/// Calls visit(mesh, flow, dt in squared mean edge lengths) for all of both.
template <class Visit>
void for_each_of_both(const BenchmarkCommand& command, Visit&& visit)
{
    for_each_mesh(command, [&](const NamedMesh& named) {
        for_each_flow(command, named, [&](const FlowOptions& flow, double dt) { visit(named, flow, dt); });
    });
}

nlohmann::ordered_json run_cells(const BenchmarkCommand& command, std::ostream& out)
{
    const bool is_grid = command.mode == BenchmarkMode::Grid;
    const GridOptions options{command.peers, command.turns, is_grid ? std::nullopt : command.flow.accuracy.tolerance,
                              is_grid};
    Table table = cell_table(out);
    std::vector<GridCell> cells;
    for_each_mesh(command, [&](const NamedMesh& named) {
        GridRunner runner(named.mesh, options);
        for_each_flow(command, named, [&](const FlowOptions& flow, double time_step_edges) {
            GridCell& cell = cells.emplace_back(runner.run(flow));
            cell.mesh = named.name;
            cell.time_step_edges = time_step_edges;
            add_cell(table, cell);
            if (!is_grid)
                require_success(cell.ours);
        });
    });
    if (is_grid)
        print_grid_summary(out, cells);
    return table.rows();
}

nlohmann::ordered_json run_whole_runs(const BenchmarkCommand& command, std::ostream& out)
{
    const GridOptions options{command.peers, command.turns};
    Table table = whole_run_table(out);
    for_each_of_both(command, [&](const NamedMesh& named, const FlowOptions& flow, double time_step_edges) {
        if (!named.file.empty())
            add_whole_run(table, {named.mesh, named.name, named.file, named.file.extension().string().substr(1)}, flow,
                          time_step_edges, options);
        else
            for (const char* format : {"obj", "ply"})
                add_whole_run(table, {named.mesh, named.name, {}, format}, flow, time_step_edges, options);
    });
    return table.rows();
}

nlohmann::ordered_json run_explanation(const BenchmarkCommand& command, std::ostream& out)
{
    Table table = explanation_table(out);
    for_each_of_both(command, [&](const NamedMesh& named, const FlowOptions& flow, double) {
        add_explanation(table, named.name, named.mesh, flow);
    });
    return table.rows();
}

nlohmann::ordered_json run_k_harmonic_steps(const BenchmarkCommand& command, std::ostream& out)
{
    Table table = k_harmonic_table(out);
    for_each_of_both(command, [&](const NamedMesh& named, const FlowOptions& flow, double) {
        add_k_harmonic(table, named.name, named.mesh, flow, command.orders);
    });
    return table.rows();
}

}  // namespace

nlohmann::ordered_json run_benchmark(const BenchmarkCommand& command, std::ostream& out)
{
    switch (command.mode) {
    case BenchmarkMode::Cell:
    case BenchmarkMode::Grid:
        break;
    case BenchmarkMode::KHarmonic:
        return run_k_harmonic_steps(command, out);
    case BenchmarkMode::Explain:
        return run_explanation(command, out);
    case BenchmarkMode::WholeRun:
        return run_whole_runs(command, out);
    }
    return run_cells(command, out);
}

}  // namespace seamflow
