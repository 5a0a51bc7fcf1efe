#include "engine/steppers/sweep_stepper.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>

#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/run_for_sub_mesh.h"
#include "engine/tasks/stopwatch.h"
#include "partition/decomposition/reverse_cuthill_mckee.h"

namespace seamflow {

SweepStepper::SweepStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                           const StepSettings& settings, const SweepSteps& sweeps, std::vector<double> curvature,
                           Progress& progress)
    : SweepStepper(mesh, topology, cut_out(mesh, topology, cut, sweeps, std::move(curvature), progress),
                   {.ranks = std::make_unique<OneRank>(cut.n_parts)}, settings, sweeps, progress)
{
}

SweepStepper::SweepStepper(const PolygonMesh& mesh, const Topology& topology, SweepSubMeshes sub_meshes,
                           RanksOfSweep ranks, const StepSettings& settings, const SweepSteps& sweeps,
                           Progress& progress)
    : sweep_(mesh, std::move(sub_meshes), settings, sweeps, workspaces_, progress)
    , ranks_(std::move(ranks))
    , seconds_(usize(sweep_.size()))
    , graph_(&progress, settings.records_schedule)
    , filter_(settings.equation.filter)
{
    const InterfaceConditions& conditions = sweeps.conditions;
    const Decomposition& decomposition = sweep_.decomposition();
    const std::vector<SweepPlan>& plans = sweep_.plans();
    if (!std::holds_alternative<SchwarzConditions>(conditions))
        error_.emplace(decomposition, mesh, topology, settings.equation, have_copies(conditions), *ranks_.ranks);

    std::vector<FactorWindow>& windows = ranks_.windows;
    const std::vector<Index> order = reverse_cuthill_mckee(decomposition.adjacency);
    for (std::size_t number = windows.size(); number < plans.size(); ++number)
        windows.push_back(least_window(plans[number], order_by_need(plans[number], order)));
    std::size_t largest = 1;
    for (const SubMeshState& state : sweep_.states())
        if (state.system)
            largest = std::max(largest, state.system->factor_bytes());
    factors_.emplace(largest);
    // With a filter of several solutions all factors are kept, because a further solution begins when the previous one
    // is complete.
    choose_size(windows, largest, !filter_.is_plain(), workspaces_.size(), settings.factors.memory_limit);

    if (ranks_.remote != nullptr)
        ranks_.remote->connect(decomposition, plans, error_->remote_rows());
    const PerformTask perform = [this](TaskKind kind, Index s) { this->perform(kind, s); };
    for (std::size_t number = 0; number < plans.size(); ++number)
        add_sweep(graph_, perform, number, plans[number], decomposition.adjacency, windows[number], sweep_.predicts(),
                  ranks_.remote);
}

/// Performs a task. The result of an own sub-mesh is sent to the ranks that wait for it at once; for a remote sub-mesh,
/// the task reads the message that has arrived.
void SweepStepper::perform(TaskKind kind, Index s)
{
    const MessageKind message = message_of(kind);
    if (sweep_.is_remote(s))
        return ranks_.remote->receive(message, s, rows_of(message, s));
    run_for_sub_mesh(sweep_.name(s), [&] { perform_own(kind, s); });
    if (ranks_.remote != nullptr && (kind == TaskKind::Predict || kind == TaskKind::Solve))
        ranks_.remote->send(message, sweep_.plan_number(), s, rows_of(message, s));
}

/// Performs a task of an own sub-mesh, and adds its time.
void SweepStepper::perform_own(TaskKind kind, Index s)
{
    SolverWorkspace& workspace = workspaces_.local();
    SubMeshState& state = sweep_.states()[s];
    PhaseSeconds& seconds = seconds_[s];
    Stopwatch watch;
    switch (kind) {
    case TaskKind::AssembleAndFactorise:
        if (state.data == nullptr) {
            const SubMeshSystem::Assembled equations = sweep_.assemble(s, workspace);
            seconds.assemble += watch.lap();
            sweep_.factorise(s, equations, *factors_, workspace);
            seconds.factorise += watch.lap();
            return;
        }
        state.system->use_data(*state.data);
        break;
    case TaskKind::Predict:
        sweep_.predict(s, workspace);
        break;
    case TaskKind::UsePredictions:
        sweep_.use_predictions(s, workspace);
        break;
    case TaskKind::Solve:
        sweep_.solve(s, workspace);
        if (filter_.is_plain())
            state.factor.reset();
        break;
    default:
        finish(s, workspace);
    }
    (kind == TaskKind::Accept ? seconds.correct : seconds.solve) += watch.lap();
}

/// Ends the work of sub-mesh s on a solution: estimates the error of the first one, and accepts it if it is the only
/// one of the step.
void SweepStepper::finish(Index s, SolverWorkspace& workspace)
{
    sweep_.receive_solutions(s);
    if (error_ && sweep_.states()[s].data == nullptr)
        error_->measure(sweep_.states(), s, workspace);
    if (filter_.is_plain())
        accept(s);
}

/// Accepts Vᵏ⁺¹ in sub-mesh s, and records its correction for the estimate.
void SweepStepper::accept(Index s)
{
    sweep_.accept(s);
    if (error_)
        error_->note_correction(sweep_.states(), s);
}

/// The array of a sub-mesh's state whose rows a message of this kind has.
Points& SweepStepper::rows_of(MessageKind kind, Index s)
{
    SubMeshState& state = sweep_.states()[s];
    switch (kind) {
    case MessageKind::Position:
        return state.position;
    case MessageKind::Prediction:
        return state.predicted;
    default:
        return state.solution;
    }
}

/// Runs the tasks of one sweep; with several ranks, sends the positions of own sub-meshes first.
/// @param join is called after all tasks.
void SweepStepper::run_sweep(const std::function<void()>& join)
{
    RemoteSubMeshes* const remote = ranks_.remote;
    const std::size_t plan = sweep_.plan_number();
    if (remote == nullptr)
        return graph_.run(plan, 0.0, join);
    const auto send_positions = [&] {
        for (Index s = 0; s < sweep_.size(); ++s)
            if (!sweep_.is_remote(s))
                remote->send(MessageKind::Position, plan, s, sweep_.states()[s].position);
    };
    remote->run(graph_, plan, send_positions, join);
}

/// Takes a step. The same graph is run once for each solution.
void SweepStepper::step(const Points& before)
{
    sweep_.set_plan(static_cast<std::size_t>(steps_done_) % sweep_.plans().size());
    const auto end = [&] {
        ++steps_done_;
        sweep_.join();
    };
    filter_.is_plain() ? run_sweep(end) : take_filtered(end);
    if (error_)
        error_->add_step(sweep_.states(), before);
}

/// Takes a step with a filter of several solutions, one sweep for each; then calls end(). Each sub-mesh filters its
/// halo, too, so that all sub-meshes at a vertex compute the same bits.
void SweepStepper::take_filtered(const std::function<void()>& end)
{
    const auto for_each_own = [&](auto&& action) {
        for_each(run_in_parallel, sweep_.size(), [&](Index s) {
            if (!sweep_.is_remote(s))
                action(s, sweep_.states()[s]);
        });
    };
    // A step that failed may have left data.
    for_each_own([](Index, SubMeshState& state) { state.data = nullptr; });
    run_sweep();
    PointBlocks rest(usize(sweep_.size()), Points(0, 3));
    PointBlocks solution = rest;
    for_each_own([&](Index s, const SubMeshState& state) { rest[s] = state.position - state.solution; });
    apply_filter(
        filter_, rest,
        [&](const PointBlocks& data) -> const PointBlocks& {
            for_each_own([&](Index s, SubMeshState& state) { state.data = &data[s]; });
            run_sweep();
            for_each_own([&](Index s, const SubMeshState& state) { solution[s] = state.solution; });
            return solution;
        },
        run_in_parallel);
    for_each_own([&](Index s, SubMeshState& state) {
        Stopwatch watch;
        state.data = nullptr;
        state.solution = state.position - rest[s];
        state.factor.reset();
        accept(s);
        seconds_[s].correct += watch.lap();
    });
    end();
}

const PolygonMesh* SweepStepper::separated() const
{
    return sweep_.gaps() != nullptr ? sweep_.gaps()->separated() : nullptr;
}

/// If copies differ, each of them is mapped; their means are then those of the image up to rounding.
void SweepStepper::set_positions(const Points& image, const SimilarityOfComponents& similarity)
{
    copy(run_in_parallel, image, sweep_.positions());
    for_each(run_in_parallel, sweep_.size(), [&](Index s) {
        SubMeshState& state = sweep_.states()[s];
        if (!has_copies())
            return sweep_.fetch_positions(s);
        for (Index v = 0; v < state.sub_mesh->n_vertices; ++v)
            state.position.row(v) = similarity(state.sub_mesh->local_to_global[v], state.position.row(v));
    });
    if (has_copies())
        sweep_.join();
}

void SweepStepper::set_vertices(std::span<const Index> vertices, const Points& to)
{
    Points& positions = sweep_.positions();
    move_rows(vertices, to, positions);
    std::vector<std::uint8_t> moves(usize(static_cast<Index>(positions.rows())), 0);
    for (const Index v : vertices)
        if (v >= 0)
            moves[v] = 1;
    for_each(run_in_parallel, sweep_.size(), [&](Index s) {
        SubMeshState& state = sweep_.states()[s];
        for (Index v = 0; v < state.sub_mesh->n_vertices; ++v)
            if (const Index global = state.sub_mesh->local_to_global[v]; moves[global] != 0)
                state.position.row(v) = positions.row(global);
    });
}

/// Sub-meshes are saved only if their copies differ: otherwise they hold no more than the whole mesh.
void SweepStepper::save(StepMemory& memory) const
{
    memory.positions = sweep_.positions();
    memory.numbers = {static_cast<double>(steps_done_)};
    for (const SubMeshState& state : sweep_.states())
        if (has_copies())
            memory.arrays.emplace_back(state.position.topRows(state.sub_mesh->n_vertices));
    if (error_)
        error_->save(memory);
}

std::vector<Index> SweepStepper::saved_vertices() const
{
    return error_ ? error_->vertices() : std::vector<Index>();
}

void SweepStepper::restore(const StepMemory& memory)
{
    StepMemoryReader reader(memory);
    sweep_.positions() = memory.positions;
    steps_done_ = reader.count();
    for (Index s = 0; s < sweep_.size(); ++s) {
        SubMeshState& state = sweep_.states()[s];
        if (const Index n_vertices = state.sub_mesh->n_vertices; has_copies())
            state.position.topRows(n_vertices) = reader.array(n_vertices);
        else
            sweep_.fetch_positions(s);
    }
    if (error_)
        error_->restore(reader);
    reader.require_end();
    sweep_.join();
}

void SweepStepper::add_seconds(PhaseSeconds& seconds) const
{
    for (const PhaseSeconds& of_sub_mesh : seconds_)
        seconds.add_tasks(of_sub_mesh);
}

void SweepStepper::report_to(StepReport& report) const
{
    if (sweep_.gaps() != nullptr)
        report.gap = sweep_.gaps()->gap();
    if (error_)
        report.estimated_v_max = error_->largest();
}

void SweepStepper::report_to(FlowReport& report) const
{
    const std::vector<Index>& stage = sweep_.plans().front().stage;
    report.cut.interface_vertices = sweep_.decomposition().n_interface_vertices;
    report.resources.live_factors = ranks_.windows.front().size;
    report.resources.factor_memory_bytes = factors_->bytes();
    for (Index s = 0; s < sweep_.size(); ++s)
        if (const SubMeshState& state = sweep_.states()[s]; state.system)
            report.cut.sub_meshes.push_back({.faces = static_cast<Index>(state.sub_mesh->faces.size()),
                                             .vertices = state.sub_mesh->n_vertices,
                                             .colour = stage[s],
                                             .p = state.p,
                                             .factorisation = state.system->factorisation(),
                                             .n_nearly_singular = state.system->n_nearly_singular()});
    add_seconds(report.seconds);
    report.schedule = graph_.schedule();
}

}  // namespace seamflow
