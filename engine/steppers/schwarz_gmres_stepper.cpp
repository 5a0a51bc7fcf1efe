#include "engine/steppers/schwarz_gmres_stepper.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "engine/measure/remarks.h"
#include "engine/tasks/parallel_loop.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "engine/tasks/stopwatch.h"
#include "partition/decomposition/local_mesh.h"
#include "partition/errors.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// Layers of faces by which sub-meshes overlap.
constexpr int overlap_layers = 2;

}  // namespace

SchwarzGmresStepper::SchwarzGmresStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                         const FlowOptions& options, Progress& progress)
    : loops_(2.0 * cut.n_parts, progress)
    , convergence_(options.accuracy.tolerance.value(), options.accuracy.converge_iterations)
    , time_step_(options.time_step)
    , factorisation_(options.resources.factorisation)
    , positions_(mesh.vertices)
    , graph_(options.report.record_schedule, progress)
{
    cut_out(mesh, topology, cut, progress.loop());
    make_blocks(options, progress);
    blocks_.equation = std::make_unique<TraceEquation>(blocks_.views, mesh.n_vertices());
    make_graph();
}

void SchwarzGmresStepper::cut_out(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const Loop& loop)
{
    // Everyone grows into everyone.
    const std::vector<Index> rank(cut.n_parts, 0);
    const Overlap overlap{cut.labels, rank, overlap_layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts, run_in_parallel);
    parts_.of.resize(faces.size());
    for_each(run_in_parallel, static_cast<Index>(faces.size()), [&](Index s) {
        parts_.of[s] = make_grown_part(mesh, topology, overlap, SchwarzBlock::reach, s, std::move(faces[s]));
    });
    parts_.n_interface_vertices = static_cast<Index>(
        select(loop, mesh.n_vertices(), [&](Index v) { return is_on_interface(topology, cut.labels, v); }).size());
}

void SchwarzGmresStepper::make_blocks(const FlowOptions& options, Progress& progress)
{
    blocks_.of.resize(parts_.of.size());
    seconds_.resize(parts_.of.size() + 1);
    progress.expect(static_cast<double>(parts_.of.size()));
    for_each(run_in_parallel, static_cast<Index>(parts_.of.size()), [&](Index s) {
        progress.require_going_on();
        run_for_sub_mesh(parts_.of[s].sub_mesh, s, [&] {
            blocks_.of[s] =
                std::make_unique<SchwarzBlock>(parts_.of[s], options.laplacian, options.resources.factorisation);
        });
        progress.count();
    });
    std::size_t largest = 1;
    for (const auto& block : blocks_.of) {
        blocks_.views.push_back(block.get());
        largest = std::max(largest, block->factor_bytes());
    }
    const std::size_t all = blocks_.of.size() * largest;
    if (options.resources.memory_limit && *options.resources.memory_limit < all)
        throw OptionError("memory_limit is " + std::to_string(*options.resources.memory_limit) +
                          " bytes, but a converged step keeps all factorisations at once, which take " +
                          std::to_string(all) + ": raise it, or take sweeps (Approach::Sweep, --converge never)");
    factors_.pool.use_blocks_of(largest);
    factors_.workspaces.use(factors_.pool);
}

void SchwarzGmresStepper::make_graph()
{
    const auto root = graph_.add_root();
    const auto solved =
        graph_.add_task({TaskKind::SolveInterface, -1, TaskPriority::Normal}, [this] { solve_traces(); });
    graph_.add_dependency(root, solved);
    for (Index s = 0; s < static_cast<Index>(blocks_.of.size()); ++s) {
        const auto factorised = graph_.add_task({TaskKind::AssembleAndFactorise, s, TaskPriority::Normal}, [this, s] {
            run_for_sub_mesh(parts_.of[s].sub_mesh, s, [&] { assemble_and_factorise(s); });
        });
        graph_.add_dependency(root, factorised);
        graph_.add_dependency(factorised, solved);
    }
}

void SchwarzGmresStepper::step(const Points& before)
{
    assert(&before != &positions_);
    before_ = &before;
    graph_.run(0, loops_.parts());
}

void SchwarzGmresStepper::assemble_and_factorise(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = factors_.workspaces.local();
    const SubMesh& sub_mesh = parts_.of[s].sub_mesh;
    set_rows(workspace.positions, sub_mesh.n_vertices);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        workspace.positions.row(v) = before_->row(sub_mesh.local_to_global[v]);
    blocks_.of[s]->assemble(workspace.positions, time_step_);
    seconds_[s].assemble += watch.lap();
    blocks_.of[s]->factorise(workspace);
    seconds_[s].factorise += watch.lap();
}

void SchwarzGmresStepper::solve_traces()
{
    const Stopwatch watch;
    positions_ = *before_;
    const IterationStop stop{convergence_.tolerance(), convergence_.most_iterations()};
    const TraceResult result =
        blocks_.equation->solve(blocks_.views, stop, positions_,
                                {loops_.begin(), [this]() -> SolverWorkspace& { return factors_.workspaces.local(); }});
    loops_.end();
    convergence_.add({result.iterations, result.residual, result.estimated_distance, result.stagnated});
    seconds_.back().interface += watch.seconds();
}

void SchwarzGmresStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    convergence_.save(memory);
}

void SchwarzGmresStepper::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    convergence_.restore(reader);
    reader.require_end();
}

void SchwarzGmresStepper::add_seconds(PhaseSeconds& seconds) const
{
    for (const PhaseSeconds& of_sub_mesh : seconds_) {
        seconds.assemble += of_sub_mesh.assemble;
        seconds.factorise += of_sub_mesh.factorise;
        seconds.interface += of_sub_mesh.interface;
    }
}

void SchwarzGmresStepper::describe(StepReport& report) const
{
    convergence_.describe(report);
}

void SchwarzGmresStepper::describe(FlowReport& report) const
{
    report.cut.interface_vertices = parts_.n_interface_vertices;
    report.resources.live_factors = static_cast<Index>(blocks_.of.size());
    report.resources.factor_memory_bytes = factors_.pool.bytes();
    for (const GrownPart& part : parts_.of)
        report.cut.sub_meshes.push_back({static_cast<Index>(part.sub_mesh.faces.size()), part.sub_mesh.n_vertices});
    add_seconds(report.seconds);
    std::vector<Index> n_nearly_singular;
    std::vector<Factorisation> factorisations;
    for (const auto& block : blocks_.of) {
        n_nearly_singular.push_back(block->n_nearly_singular());
        if (const auto used = block->factorisation())
            factorisations.push_back(*used);
    }
    remark_on_factorisation(factorisation_, factorisations, report);
    remark_on_near_singularity(n_nearly_singular, report);
    convergence_.describe(report, "use fewer sub-meshes or a smaller time step");
    report.schedule = graph_.schedule();
}

}  // namespace seamflow
