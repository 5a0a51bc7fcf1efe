#include "engine/decomposed_flow.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>
#include <string>

#include "engine/flow_remarks.h"
#include "engine/on_behalf_of.h"
#include "engine/parallel_loop.h"
#include "engine/release.h"
#include "engine/sub_mesh_options.h"
#include "engine/sweep_order.h"
#include "partition/decomposition/narrow_order.h"
#include "partition/decomposition/overlap.h"
#include "partition/errors.h"
#include "solvers/interface/residual_indicator.h"

namespace seamflow {

namespace {

/// Whether a sub-mesh takes over something that another has solved.
[[maybe_unused]] bool follows(const SweepPlan& plan, Index s, Index leader)
{
    return std::ranges::any_of(plan.traces[at(s)], [&](const Transfer& trace) { return trace.from == leader; });
}

/// New memory is slow to come by: all threads take of it.
Points copied(const Points& positions)
{
    Points copy(positions.rows(), 3);
    run_in_parallel(static_cast<Index>(positions.rows()), [&](Index begin, Index end) {
        copy.middleRows(begin, end - begin) = positions.middleRows(begin, end - begin);
    });
    return copy;
}

/// The sub-meshes of a cut, grown into each other for a sweep in ascending order of `rank`.
Decomposition overlap_sub_meshes(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                 std::span<const Index> rank, int layers)
{
    const Overlap overlap{cut.labels, rank, layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts, run_in_parallel);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(run_in_parallel, static_cast<Index>(faces.size()), [&](Index s) {
        sub_meshes[at(s)] = make_overlapping_sub_mesh(mesh, topology, overlap, s, std::move(faces[at(s)]));
    });
    return connect_overlapping(std::move(sub_meshes), topology, overlap);
}

}  // namespace

DecomposedFlow::DecomposedFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                               const FlowOptions& options, const std::vector<double>& curvature, Progress& progress)
    : decomposition_(decompose(mesh, topology, cut.labels, cut.n_parts, progress.loop()))
    , recorder_(options.record_schedule ? std::make_unique<ScheduleRecorder>() : nullptr)
    , graph_(recorder_.get(), &progress)
    , positions_(copied(mesh.vertices))
    , has_copies_(is_classical(options.conditions) || options.conditions == Conditions::Schwarz)
{
    const auto rank = rank_sub_meshes(decomposition_, options.coloring, curvature);
    if (options.conditions == Conditions::Schwarz)
        decomposition_ = overlap_sub_meshes(mesh, topology, cut, rank, options.overlap);
    progress.require_going_on();
    if (is_classical(options.conditions))
        copies_.emplace(mesh, decomposition_, options.keep_gaps);
    make_states(mesh, options, progress);
    run_both(
        [&] {
            if (options.conditions != Conditions::Schwarz && has_indicator_row(options.laplacian))
                drift_.emplace(decomposition_, mesh, topology, options);
        },
        [&] {
            plans_.push_back(make_plan(decomposition_, options, rank));
            if (alternates(options, states_.size()))
                plans_.push_back(make_plan(decomposition_, options, reversed(rank)));
        });
    limit_factors(options);
    for (const SweepPlan& plan : plans_)
        roots_.push_back(add_sweep(plan, options));
}

/// Without a limit, each thread has work enough within the window.
void DecomposedFlow::limit_factors(const FlowOptions& options)
{
    constexpr Index places_per_thread = 4;
    std::size_t largest = 1;
    for (const SubMeshState& state : states_)
        largest = std::max(largest, state.system->factor_bytes());
    factors_.use_blocks_of(largest);
    workspaces_.use(factors_);

    window_.order = narrow_order(decomposition_.adjacency);
    Index least = 0;
    for (const SweepPlan& plan : plans_)
        least = std::max(least, least_window(plan, window_.order));
    const auto n = static_cast<Index>(states_.size());
    window_.size = std::min(n, least + places_per_thread * workspaces_.size());
    if (!options.memory_limit)
        return;
    const std::size_t places = *options.memory_limit / largest;
    if (places < at(least))
        throw OptionError("memory_limit is " + std::to_string(*options.memory_limit) + " bytes, but the " +
                          std::to_string(least) + " factorisations that a step needs at once take " +
                          std::to_string(at(least) * largest) + ": raise it, or use more sub-meshes");
    window_.size = static_cast<Index>(std::min(at(n), places));
}

void DecomposedFlow::make_states(const PolygonMesh& mesh, const FlowOptions& options, Progress& progress)
{
    std::vector<std::optional<SubMeshState>> made(decomposition_.sub_meshes.size());
    progress.expect(static_cast<double>(made.size()));
    for_each(run_in_parallel, static_cast<Index>(made.size()), [&](Index s) {
        progress.require_going_on();
        SubMesh& sub_mesh = decomposition_.sub_meshes[at(s)];
        on_behalf_of(sub_mesh, s, [&] {
            SubMeshState& state =
                made[at(s)].emplace(sub_mesh, make_equations(sub_mesh, options, workspaces_.local()), mesh.vertices);
            state.p = robin_parameter(sub_mesh, state.position, options);
            // The estimate looks at the corners of the faces at Γ.
            release_faces(std::max(state.system->faces_in_use(), FacesInUse::Corners), sub_mesh);
        });
        progress.count();
    });
    states_.reserve(made.size());
    for (auto& state : made)
        states_.push_back(std::move(*state));
}

template <class Body>
TaskGraph::Node DecomposedFlow::add_task(Phase phase, Index s, Body body, TaskGraph::Priority priority)
{
    const auto node = graph_.add_task(
        [this, s, body] { on_behalf_of(*states_[at(s)].sub_mesh, s, [&] { body(s, workspaces_.local()); }); },
        priority);
    if (recorder_)
        recorder_->add_task(node, {phase, s, priority});
    return node;
}

TaskGraph::Node DecomposedFlow::add_sweep(const SweepPlan& plan, const FlowOptions& options)
{
    const auto n = static_cast<Index>(states_.size());
    const double time_step = options.time_step;
    const bool corrected = corrects(options);
    const bool mutual = is_classical(options.conditions);
    const auto assemble_one = [this, &plan, time_step, mutual](Index s, SolverWorkspace& workspace) {
        mutual
            ? assemble_and_factorise_mutual(states_, s, decomposition_.halo[at(s)], plan, time_step, workspace)
            : assemble_and_factorise(states_, s, decomposition_.halo[at(s)], plan.roles[at(s)], time_step, workspace);
    };
    const auto solve_one = [this, &plan, mutual](Index s, SolverWorkspace& workspace) {
        mutual ? solve_mutual(states_, s, decomposition_.halo[at(s)], plan, workspace)
               : solve(states_, s, plan.traces[at(s)], workspace);
    };
    const auto accept_one = [this, corrected](Index s, SolverWorkspace& workspace) {
        if (drift_)
            drift_->measure(states_, s, workspace);
        corrected ? accept_corrected(states_, s, decomposition_.halo[at(s)]) : accept(states_, s);
        if (drift_)
            drift_->note_correction(states_, s);
    };

    const TaskGraph::Node root = graph_.add_root();
    std::vector<TaskGraph::Node> factorised;
    std::vector<TaskGraph::Node> solved;
    for (Index s = 0; s < n; ++s) {
        factorised.push_back(add_task(Phase::AssembleAndFactorise, s, assemble_one, TaskGraph::Priority::Normal));
        solved.push_back(add_task(Phase::Solve, s, solve_one, TaskGraph::Priority::High));
        graph_.add_dependency(root, factorised.back());
        graph_.add_dependency(factorised.back(), solved.back());
    }
    add_window(factorised, solved);
    add_traces(plan, solved);
    if (predicts(options))
        add_predictions(plan, factorised, solved);
    for (Index s = 0; s < n; ++s) {
        const auto accepted = add_task(Phase::Accept, s, accept_one, TaskGraph::Priority::High);
        graph_.add_dependency(solved[at(s)], accepted);
        for (const Index neighbour : decomposition_.adjacency[at(s)])
            graph_.add_dependency(solved[at(neighbour)], accepted);
    }
    return root;
}

/// A factor waits for room.
void DecomposedFlow::add_window(const std::vector<TaskGraph::Node>& factorised,
                                const std::vector<TaskGraph::Node>& solved)
{
    for (std::size_t i = 0; i + at(window_.size) < window_.order.size(); ++i)
        graph_.add_dependency(solved[at(window_.order[i])], factorised[at(window_.order[i + at(window_.size)])]);
}

/// A solve waits for those whose Vᵏ⁺¹ it takes.
void DecomposedFlow::add_traces(const SweepPlan& plan, const std::vector<TaskGraph::Node>& solved)
{
    for (std::size_t s = 0; s < states_.size(); ++s) {
        for (const Transfer& trace : plan.traces[s])
            graph_.add_dependency(solved[at(trace.from)], solved[s]);
        for (const Transfer& copies : plan.copies[s])
            if (plan.rank[at(copies.from)] < plan.rank[s])
                graph_.add_dependency(solved[at(copies.from)], solved[s]);
    }
}

/// Between factorising and solving: every sub-mesh that another one leads predicts, and the leading one takes that up.
void DecomposedFlow::add_predictions(const SweepPlan& plan, const std::vector<TaskGraph::Node>& factorised,
                                     const std::vector<TaskGraph::Node>& solved)
{
    const auto n = static_cast<Index>(states_.size());
    std::vector<TaskGraph::Node> predicted(at(n), -1);
    const auto predict_one = [this](Index s, SolverWorkspace& workspace) { predict(states_, s, workspace); };
    const auto use_one = [this, &plan](Index s, SolverWorkspace& workspace) {
        use_predictions(states_, s, plan.predictions[at(s)], workspace);
    };
    for (Index s = 0; s < n; ++s) {
        if (plan.traces[at(s)].empty())
            continue;
        predicted[at(s)] = add_task(Phase::Predict, s, predict_one, TaskGraph::Priority::High);
        graph_.add_dependency(factorised[at(s)], predicted[at(s)]);
        graph_.add_dependency(predicted[at(s)], solved[at(s)]);
    }
    for (Index s = 0; s < n; ++s) {
        if (plan.predictions[at(s)].empty())
            continue;
        const auto used = add_task(Phase::UsePredictions, s, use_one, TaskGraph::Priority::High);
        graph_.add_dependency(factorised[at(s)], used);
        graph_.add_dependency(used, solved[at(s)]);
        if (predicted[at(s)] >= 0)
            graph_.add_dependency(predicted[at(s)], used);
        for (const Transfer& prediction : plan.predictions[at(s)]) {
            // Who predicts follows here, and waits with its solution: see SubMeshState::solved.
            assert(follows(plan, prediction.from, s));
            graph_.add_dependency(predicted[at(prediction.from)], used);
        }
    }
}

void DecomposedFlow::step(const Points& before)
{
    if (recorder_)
        recorder_->begin_step();
    graph_.run(roots_[static_cast<std::size_t>(steps_done_) % roots_.size()]);
    ++steps_done_;
    if (drift_)
        drift_->add_step(before);
    join();
    if (recorder_)
        recorder_->end_step();
}

void DecomposedFlow::join()
{
    for_each(run_in_parallel, static_cast<Index>(states_.size()), [&](Index s) {
        const SubMesh& sub_mesh = *states_[at(s)].sub_mesh;
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            if (sub_mesh.owned[at(v)] != 0)
                positions_.row(sub_mesh.local_to_global[at(v)]) = states_[at(s)].position.row(v);
    });
    if (copies_)
        copies_->join(states_, positions_);
}

/// Sub-meshes that do not differ have no more than the whole mesh has.
void DecomposedFlow::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.numbers = {static_cast<double>(steps_done_)};
    for (const SubMeshState& state : states_)
        if (has_copies_)
            memory.arrays.emplace_back(state.position.topRows(state.sub_mesh->n_vertices));
    if (drift_)
        drift_->save(memory);
}

void DecomposedFlow::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    positions_ = memory.positions;
    steps_done_ = reader.count();
    for (SubMeshState& state : states_) {
        const SubMesh& sub_mesh = *state.sub_mesh;
        if (has_copies_)
            state.position.topRows(sub_mesh.n_vertices) = reader.array(sub_mesh.n_vertices);
        else
            for (Index v = 0; v < sub_mesh.n_vertices; ++v)
                state.position.row(v) = positions_.row(sub_mesh.local_to_global[at(v)]);
    }
    if (drift_)
        drift_->restore(reader);
    reader.require_end();
    join();
}

void DecomposedFlow::add_seconds(PhaseSeconds& seconds) const
{
    for (const SubMeshState& state : states_) {
        seconds.assemble += state.seconds.assemble;
        seconds.factorise += state.seconds.factorise;
        seconds.solve += state.seconds.solve;
        seconds.correct += state.seconds.correct;
    }
}

void DecomposedFlow::describe(StepReport& report) const
{
    if (copies_)
        report.gap = copies_->gap();
    if (drift_)
        report.estimated_v_max = drift_->largest();
}

void DecomposedFlow::describe(FlowReport& report) const
{
    report.subdomains = static_cast<Index>(states_.size());
    report.interface_vertices = decomposition_.n_interface_vertices;
    report.subdomain_colors = plans_.front().rank;
    report.live_factors = window_.size;
    report.factor_memory_bytes = factors_.bytes();
    report.colors = states_.empty() ? 0 : *std::max_element(plans_.front().rank.begin(), plans_.front().rank.end()) + 1;
    std::vector<Index> n_nearly_singular;
    for (const SubMeshState& state : states_) {
        report.subdomain_faces.push_back(static_cast<Index>(state.sub_mesh->faces.size()));
        report.subdomain_vertices.push_back(state.sub_mesh->n_vertices);
        report.p.push_back(state.p);
        n_nearly_singular.push_back(state.system->n_nearly_singular());
    }
    remark_on_near_singularity(n_nearly_singular, report);
    add_seconds(report.seconds);
    if (recorder_)
        report.schedule = recorder_->schedule();
}

}  // namespace seamflow
