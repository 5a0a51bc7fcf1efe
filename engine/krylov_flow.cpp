#include "engine/krylov_flow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "engine/flow_remarks.h"
#include "engine/on_behalf_of.h"
#include "engine/parallel_loop.h"
#include "engine/stopwatch.h"
#include "partition/decomposition/local_mesh.h"
#include "partition/errors.h"
#include "solvers/set_rows.h"

namespace seamflow {

namespace {

/// Layers of faces by which sub-meshes overlap.
constexpr int overlap_layers = 2;

}  // namespace

KrylovFlow::KrylovFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                       Progress& progress)
    : mesh_(&mesh)
    , progress_(&progress)
    , loops_(2.0 * cut.n_parts)
    , stop_{options.tolerance.value(), options.converge_iterations}
    , time_step_(options.time_step)
    , positions_(mesh.vertices)
    , recorder_(options.record_schedule ? std::make_unique<ScheduleRecorder>() : nullptr)
    , graph_(recorder_.get(), &progress)
{
    cut_out(topology, cut);
    make_blocks(options);
    equation_ = std::make_unique<TraceEquation>(block_views_, mesh.n_vertices());
    make_graph();
}

void KrylovFlow::cut_out(const Topology& topology, const Cut& cut)
{
    // Everyone grows into everyone.
    const std::vector<Index> rank(at(cut.n_parts), 0);
    const Overlap overlap{cut.labels, rank, overlap_layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts, run_in_parallel);
    parts_.resize(faces.size());
    for_each(run_in_parallel, static_cast<Index>(faces.size()), [&](Index s) {
        parts_[at(s)] = make_grown_part(*mesh_, topology, overlap, SchwarzBlock::reach, s, std::move(faces[at(s)]));
    });
    n_interface_vertices_ = static_cast<Index>(select(progress_->loop(), mesh_->n_vertices(), [&](Index v) {
                                                   return is_on_interface(topology, cut.labels, v);
                                               }).size());
}

void KrylovFlow::make_blocks(const FlowOptions& options)
{
    blocks_.resize(parts_.size());
    seconds_.resize(parts_.size());
    progress_->expect(static_cast<double>(parts_.size()));
    for_each(run_in_parallel, static_cast<Index>(parts_.size()), [&](Index s) {
        progress_->require_going_on();
        on_behalf_of(parts_[at(s)].sub_mesh, s,
                     [&] { blocks_[at(s)] = std::make_unique<SchwarzBlock>(parts_[at(s)], options.laplacian); });
        progress_->count();
    });
    std::size_t largest = 1;
    for (const auto& block : blocks_) {
        block_views_.push_back(block.get());
        largest = std::max(largest, block->factor_bytes());
    }
    const std::size_t all = blocks_.size() * largest;
    if (options.memory_limit && *options.memory_limit < all)
        throw OptionError("memory_limit is " + std::to_string(*options.memory_limit) +
                          " bytes, but a converged step keeps all factorisations at once, which take " +
                          std::to_string(all) + ": raise it, or take sweeps (Approach::Sweep, --converge never)");
    factors_.use_blocks_of(largest);
    workspaces_.use(factors_);
}

void KrylovFlow::make_graph()
{
    const auto add_task = [&](Phase phase, Index s, std::function<void()> body) {
        const auto node = graph_.add_task(std::move(body), TaskGraph::Priority::Normal);
        if (recorder_)
            recorder_->add_task(node, {phase, s, TaskGraph::Priority::Normal});
        return node;
    };
    root_ = graph_.add_root();
    const auto solved = add_task(Phase::SolveInterface, -1, [this] { solve_traces(); });
    graph_.add_dependency(root_, solved);
    for (Index s = 0; s < static_cast<Index>(blocks_.size()); ++s) {
        const auto factorised = add_task(Phase::AssembleAndFactorise, s, [this, s] {
            on_behalf_of(parts_[at(s)].sub_mesh, s, [&] { assemble_and_factorise(s); });
        });
        graph_.add_dependency(root_, factorised);
        graph_.add_dependency(factorised, solved);
    }
}

void KrylovFlow::step(const Points& before)
{
    assert(&before != &positions_);
    before_ = &before;
    if (recorder_)
        recorder_->begin_step();
    graph_.run(root_, loops_.parts());
    if (recorder_)
        recorder_->end_step();
}

void KrylovFlow::assemble_and_factorise(Index s)
{
    Stopwatch watch;
    SolverWorkspace& workspace = workspaces_.local();
    const SubMesh& sub_mesh = parts_[at(s)].sub_mesh;
    set_rows(workspace.positions, sub_mesh.n_vertices);
    for (Index v = 0; v < sub_mesh.n_vertices; ++v)
        workspace.positions.row(v) = before_->row(sub_mesh.local_to_global[at(v)]);
    blocks_[at(s)]->assemble(workspace.positions, time_step_);
    seconds_[at(s)].assemble += watch.lap();
    blocks_[at(s)]->factorise(workspace);
    seconds_[at(s)].factorise += watch.lap();
}

void KrylovFlow::solve_traces()
{
    const Stopwatch watch;
    positions_ = *before_;
    result_ =
        equation_->solve(block_views_, stop_, positions_,
                         {loops_.begin(*progress_), [this]() -> SolverWorkspace& { return workspaces_.local(); }});
    loops_.end(*progress_);
    if (!(result_.residual <= stop_.tolerance))
        ++steps_short_of_tolerance_;
    if (result_.stagnated)
        ++steps_stagnated_;
    distance_ = std::hypot(distance_, result_.distance);
    trace_seconds_ += watch.seconds();
}

void KrylovFlow::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.numbers = {distance_, static_cast<double>(steps_short_of_tolerance_), static_cast<double>(steps_stagnated_)};
}

void KrylovFlow::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    distance_ = reader.number();
    steps_short_of_tolerance_ = reader.count();
    steps_stagnated_ = reader.count();
    reader.require_end();
}

void KrylovFlow::add_seconds(PhaseSeconds& seconds) const
{
    for (const PhaseSeconds& of_sub_mesh : seconds_) {
        seconds.assemble += of_sub_mesh.assemble;
        seconds.factorise += of_sub_mesh.factorise;
    }
    seconds.interface += trace_seconds_;
}

void KrylovFlow::describe(StepReport& report) const
{
    report.iterations = result_.iterations;
    report.residual = result_.residual;
    report.estimated_v_max = distance_;
}

void KrylovFlow::describe(FlowReport& report) const
{
    report.subdomains = static_cast<Index>(blocks_.size());
    report.colors = blocks_.empty() ? 0 : 1;
    report.interface_vertices = n_interface_vertices_;
    report.subdomain_colors.assign(blocks_.size(), 0);
    report.p.assign(blocks_.size(), 0.0);
    report.live_factors = report.subdomains;
    report.factor_memory_bytes = factors_.bytes();
    for (const GrownPart& part : parts_) {
        report.subdomain_faces.push_back(static_cast<Index>(part.sub_mesh.faces.size()));
        report.subdomain_vertices.push_back(part.sub_mesh.n_vertices);
    }
    add_seconds(report.seconds);
    std::vector<Index> n_nearly_singular;
    for (const auto& block : blocks_)
        n_nearly_singular.push_back(block->n_nearly_singular());
    remark_on_near_singularity(n_nearly_singular, report);
    report.steps_short_of_tolerance = steps_short_of_tolerance_;
    report.steps_stagnated = steps_stagnated_;
    remark_on_missed_tolerance(stop_.iterations, "use fewer sub-meshes or a smaller time step", report);
    if (recorder_)
        report.schedule = recorder_->schedule();
}

}  // namespace seamflow
