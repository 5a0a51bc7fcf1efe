#include "engine/decomposed_flow.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "engine/parallel_loop.h"
#include "engine/single_threaded_libraries.h"
#include "engine/sweep_order.h"
#include "partition/decomposition/overlap.h"
#include "partition/errors.h"
#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/adapted_ventcell.h"
#include "solvers/conditions/robin.h"
#include "solvers/conditions/ventcell.h"
#include "solvers/interface/robin_parameter.h"

namespace seamflow {

namespace {

namespace tbb = oneapi::tbb;

/// Runs `body` for a sub-mesh, in one thread; failures come out with its name.
template <class Body>
void on_behalf_of(const SubMesh& sub_mesh, Index s, Body&& body)
{
    const auto name = [&] {
        return "sub-mesh " + std::to_string(s) + " (" + std::to_string(sub_mesh.n_vertices) +
               " vertices, among its faces number " + std::to_string(sub_mesh.faces.front()) + "): ";
    };
    const SingleThreadedOpenMp single_threaded;
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(name() + error.what());
    } catch (const std::bad_alloc&) {
        throw ComputationError(name() + "out of memory: use more sub-meshes");
    }
}

/// Whether sub-meshes tell each other what they would do.
bool predicts(const FlowOptions& options)
{
    return options.conditions == Conditions::AdaptedRobin && options.transmission == Transmission::Predicted &&
           !options.p && options.p_rule == PRule::Paper && options.p_edge == PEdge::Automatic;
}

std::unique_ptr<SubMeshSystem> make_equations(const SubMesh& sub_mesh, const FlowOptions& options,
                                              SolverWorkspace& workspace)
{
    const auto with = [&](std::unique_ptr<TransmissionCondition> condition) {
        return make_system(sub_mesh, options.laplacian, std::move(condition), workspace);
    };
    switch (options.conditions) {
    case Conditions::AdaptedRobin:
        break;
    case Conditions::AdaptedVentcell:
        return with(make_adapted_ventcell(sub_mesh, options.q.value()));
    case Conditions::Robin:
        return with(make_robin(sub_mesh));
    case Conditions::Ventcell:
        return with(make_ventcell(sub_mesh, options.q.value()));
    case Conditions::Schwarz:
        return make_following_system(sub_mesh, options.laplacian, workspace);
    }
    return predicts(options) ? make_predicted_system(sub_mesh, options.laplacian, workspace)
                             : with(make_adapted_robin(sub_mesh));
}

/// With a good prediction the other side answers to what Γ adds like a half plane: with the derivative 1/√dt, so that
/// dt p = √dt would be right for smooth surfaces. Measured on twelve meshes, Δ_A and Δ_P, a little less is better.
constexpr double predicted_p_in_diffusion_lengths = 0.7;

/// In 1/length.
double robin_parameter(const SubMesh& sub_mesh, const Points& positions, const FlowOptions& options)
{
    if (sub_mesh.interface.vertices.empty() || options.conditions == Conditions::Schwarz)
        return 0.0;
    if (options.p)
        return *options.p;
    if (predicts(options))
        return predicted_p_in_diffusion_lengths / std::sqrt(options.time_step);
    const double eta = options.p_rule == PRule::InverseStep ? 1.0 / options.time_step : 1.0;
    return optimal_robin_parameter(sub_mesh, positions, eta, options.p_edge);
}

bool alternates(const FlowOptions& options, std::size_t n_sub_meshes)
{
    return options.sweep == Sweep::Alternating || (options.sweep == Sweep::Automatic && n_sub_meshes > 2);
}

bool corrects(const FlowOptions& options)
{
    return options.correction == Correction::Centroid ||
           (options.correction == Correction::Automatic &&
            (options.conditions == Conditions::AdaptedRobin || options.conditions == Conditions::AdaptedVentcell));
}

SweepPlan make_plan(const Decomposition& decomposition, Conditions conditions, const std::vector<Index>& rank)
{
    if (conditions == Conditions::Schwarz)
        return plan_overlapping_sweep(decomposition, rank);
    return is_classical(conditions) ? plan_mutual_sweep(decomposition, rank) : plan_sweep(decomposition, rank);
}

/// The sub-meshes of a cut, grown into each other for a sweep in ascending order of `rank`.
Decomposition overlap_sub_meshes(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                 std::span<const Index> rank, int layers)
{
    const Overlap overlap{cut.labels, rank, layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts);
    std::vector<SubMesh> sub_meshes(faces.size());
    tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t s) {
        sub_meshes[s] = make_overlapping_sub_mesh(mesh, topology, overlap, static_cast<Index>(s), std::move(faces[s]));
    });
    return connect_overlapping(std::move(sub_meshes), topology, overlap);
}

}  // namespace

DecomposedFlow::DecomposedFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                               const FlowOptions& options, const std::vector<double>& curvature)
    : workspaces_(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()))
    , decomposition_(decompose(mesh, topology, cut.labels, cut.n_parts, run_in_parallel))
    , recorder_(options.record_schedule ? std::make_unique<ScheduleRecorder>() : nullptr)
    , graph_(recorder_.get())
    , positions_(mesh.vertices)
{
    const auto rank = rank_sub_meshes(decomposition_, options.coloring, curvature);
    const bool overlaps = options.conditions == Conditions::Schwarz;
    if (overlaps)
        decomposition_ = overlap_sub_meshes(mesh, topology, cut, rank, options.overlap);
    make_states(mesh, options);
    if (is_classical(options.conditions))
        copies_.emplace(mesh, decomposition_, options.keep_gaps);
    plans_.push_back(make_plan(decomposition_, options.conditions, rank));
    if (!overlaps && alternates(options, states_.size()))
        plans_.push_back(make_plan(decomposition_, options.conditions, reversed(rank)));
    for (const SweepPlan& plan : plans_)
        roots_.push_back(add_sweep(plan, options));
}

void DecomposedFlow::make_states(const PolygonMesh& mesh, const FlowOptions& options)
{
    std::vector<std::optional<SubMeshState>> made(decomposition_.sub_meshes.size());
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t s) {
        const SubMesh& sub_mesh = decomposition_.sub_meshes[s];
        on_behalf_of(sub_mesh, static_cast<Index>(s),
                     [&] { made[s].emplace(sub_mesh, make_equations(sub_mesh, options, workspace()), mesh.vertices); });
        made[s]->p = robin_parameter(sub_mesh, made[s]->position, options);
    });
    states_.reserve(made.size());
    for (auto& state : made)
        states_.push_back(std::move(*state));
}

template <class Body>
TaskGraph::Node DecomposedFlow::add_task(Phase phase, Index s, Body body, TaskGraph::Priority priority)
{
    const auto node = graph_.add_task(
        [this, s, body] { on_behalf_of(*states_[at(s)].sub_mesh, s, [&] { body(s, workspace()); }); }, priority);
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
    const auto accept_one = [this, corrected](Index s, SolverWorkspace&) {
        corrected ? accept_corrected(states_, s, decomposition_.halo[at(s)]) : accept(states_, s);
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
    const auto use_one = [this, &plan](Index s, SolverWorkspace&) {
        use_predictions(states_, s, plan.predictions[at(s)]);
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
        for (const Transfer& prediction : plan.predictions[at(s)])
            graph_.add_dependency(predicted[at(prediction.from)], used);
    }
}

void DecomposedFlow::step()
{
    if (recorder_)
        recorder_->begin_step();
    graph_.run(roots_[static_cast<std::size_t>(steps_done_) % roots_.size()]);
    ++steps_done_;
    join();
    if (recorder_)
        recorder_->end_step();
}

/// That of the calling thread.
SolverWorkspace& DecomposedFlow::workspace()
{
    return workspaces_.at(static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()));
}

void DecomposedFlow::join()
{
    tbb::parallel_for(std::size_t{0}, states_.size(), [&](std::size_t s) {
        const SubMesh& sub_mesh = *states_[s].sub_mesh;
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            if (sub_mesh.owned[at(v)] != 0)
                positions_.row(sub_mesh.local_to_global[at(v)]) = states_[s].position.row(v);
    });
    if (copies_)
        copies_->join(states_, positions_);
}

void DecomposedFlow::describe(StepReport& report) const
{
    if (copies_)
        report.gap = copies_->gap();
}

void DecomposedFlow::describe(FlowReport& report) const
{
    report.subdomains = static_cast<Index>(states_.size());
    report.interface_vertices = decomposition_.n_interface_vertices;
    report.subdomain_colors = plans_.front().rank;
    report.colors = states_.empty() ? 0 : *std::max_element(plans_.front().rank.begin(), plans_.front().rank.end()) + 1;
    for (const SubMeshState& state : states_) {
        report.subdomain_faces.push_back(static_cast<Index>(state.sub_mesh->faces.size()));
        report.subdomain_vertices.push_back(state.sub_mesh->n_vertices);
        report.p.push_back(state.p);
        report.seconds.assemble += state.seconds.assemble;
        report.seconds.factorise += state.seconds.factorise;
        report.seconds.solve += state.seconds.solve;
        report.seconds.correct += state.seconds.correct;
    }
    if (recorder_)
        report.schedule = recorder_->schedule();
}

}  // namespace seamflow
