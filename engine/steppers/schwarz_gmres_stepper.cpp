#include "engine/steppers/schwarz_gmres_stepper.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/measure/remarks.h"
#include "engine/tasks/parallel_executor.h"
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
    : ConvergedStepper(mesh, cut.n_parts, options, 2.0 * cut.n_parts, progress)
    , factorisation_(options.resources.factorisation)
{
    cut_out(mesh, topology, cut, progress.exec());
    make_blocks(options, progress);
    limit_factors(options);
    equation_.emplace(blocks_.of, mesh.n_vertices());
    make_graph();
}

void SchwarzGmresStepper::cut_out(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                  const Executor& exec)
{
    // All sub-meshes grow into each other.
    const std::vector<Index> rank(cut.n_parts, 0);
    const Overlap overlap{cut.labels, rank, overlap_layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts, run_in_parallel);
    parts_.resize(faces.size());
    for_each(run_in_parallel, static_cast<Index>(faces.size()), [&](Index s) {
        parts_[s] = make_grown_part(mesh, topology, overlap, SchwarzBlock::reach, s, std::move(faces[s]));
    });
    n_interface_vertices_ = static_cast<Index>(
        select(exec, mesh.n_vertices(), [&](Index v) { return is_on_interface(topology, cut.labels, v); }).size());
}

void SchwarzGmresStepper::make_blocks(const FlowOptions& options, Progress& progress)
{
    blocks_.of.resize(parts_.size());
    blocks_.factors.resize(parts_.size());
    progress.expect(static_cast<double>(parts_.size()));
    for_each(run_in_parallel, static_cast<Index>(parts_.size()), [&](Index s) {
        progress.require_going_on();
        run_for_sub_mesh(parts_[s].sub_mesh, s, [&] {
            blocks_.of[s] = std::make_unique<SchwarzBlock>(parts_[s], options.laplacian,
                                                           options.resources.factorisation, options.motion.strength);
        });
        progress.count();
    });
}

void SchwarzGmresStepper::limit_factors(const FlowOptions& options)
{
    std::size_t largest = 1;
    for (const auto& block : blocks_.of)
        largest = std::max(largest, block->factor_bytes());
    const std::size_t all = blocks_.of.size() * largest;
    if (options.resources.memory_limit && *options.resources.memory_limit < all)
        throw OptionError("memory_limit is " + std::to_string(*options.resources.memory_limit) +
                          " bytes, but a converged step keeps all factorisations at once, which take " +
                          std::to_string(all) + ": raise it, or use sweeps (Approach::Sweep)");
    memory_.emplace(largest);
}

void SchwarzGmresStepper::make_graph()
{
    for (Index s = 0; s < static_cast<Index>(parts_.size()); ++s) {
        const auto factorised = graph_.add_task({TaskKind::AssembleAndFactorise, s, TaskPriority::Normal}, [this, s] {
            run_for_sub_mesh(parts_[s].sub_mesh, s, [&] { assemble_and_factorise(s); });
        });
        graph_.add_dependency(root_, factorised);
        graph_.add_dependency(factorised, equation_solved_);
    }
}

void SchwarzGmresStepper::assemble_and_factorise(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = workspaces_.local();
    SchwarzBlock& block = *blocks_.of[s];
    const auto equations =
        block.assemble(gather_rows(parts_[s].sub_mesh.local_to_global, *before_, workspace.positions), time_step_);
    seconds_[s].assemble += watch.lap();
    blocks_.factors[s].reset();
    blocks_.factors[s] = block.factorise(equations, *memory_, workspace);
    seconds_[s].factorise += watch.lap();
}

InterfaceResult SchwarzGmresStepper::solve_equation(const IterationStop& stop, const Executor& exec)
{
    positions_ = *before_;
    return equation_->solve({blocks_.of, blocks_.factors}, stop, positions_,
                            {exec, [this]() -> SolverWorkspace& { return workspaces_.local(); }});
}

void SchwarzGmresStepper::describe(FlowReport& report) const
{
    report.cut.interface_vertices = n_interface_vertices_;
    report.resources.live_factors = static_cast<Index>(parts_.size());
    report.resources.factor_memory_bytes = memory_->bytes();
    std::vector<Index> n_nearly_singular;
    std::vector<Factorisation> factorisations;
    for (const auto& block : blocks_.of) {
        n_nearly_singular.push_back(block->n_nearly_singular());
        if (const auto used = block->factorisation())
            factorisations.push_back(*used);
    }
    remark_on_factorisation(factorisation_, factorisations, report);
    remark_on_near_singularity(n_nearly_singular, report);
    describe_parts(parts_, "use fewer sub-meshes or a smaller time step", report);
}

}  // namespace seamflow
