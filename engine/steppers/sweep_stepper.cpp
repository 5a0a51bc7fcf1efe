#include "engine/steppers/sweep_stepper.h"

#include <utility>

#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/stopwatch.h"

namespace seamflow {

/// Performs a task. The result of an own sub-mesh is sent to the ranks that wait for it at once; for a remote sub-mesh,
/// the task reads the message that has arrived.
void SweepStepper::perform(TaskKind kind, Index s)
{
    const MessageKind message = message_of(kind);
    if (!is_own(s))
        return remote_->receive(message, s, rows_of(message, s));
    run_for_sub_mesh(names_[s], [&] { perform_own(kind, s); });
    if (remote_ != nullptr && (kind == TaskKind::Predict || kind == TaskKind::Solve))
        remote_->send(message, sweep_, s, rows_of(message, s));
}

/// Performs a task of an own sub-mesh. The rows of A are those of I + dt Δ; on Γ they are the transmission condition
/// where the sub-mesh leads, and the identity where it follows (see SubMeshSystem).
void SweepStepper::perform_own(TaskKind kind, Index s)
{
    SolverWorkspace& workspace = workspaces_.local();
    SubMeshState& state = states_[s];
    Stopwatch watch;
    switch (kind) {
    case TaskKind::AssembleAndFactorise:
        // A(Vᵏ) = L U
        if (state.solution != SubMeshState::Solution::OfData)
            return assemble_and_factorise(states_, s, decomposition_.halo[s], plan(), time_step_, *factors_, workspace);
        state.system->use_data(state.data);
        break;
    case TaskKind::Predict:
        // A x = Vᵏ, with x = Vᵏ on Γ
        predict(state, workspace);
        break;
    case TaskKind::UsePredictions:
        // b: Vᵏ, and on Γ the condition with x beyond it
        use_predictions(states_, s, plan().predictions[s], workspace);
        break;
    case TaskKind::Solve:
        // A Vᵏ⁺¹ = b, with Vᵏ⁺¹ of the sub-meshes that lead it on Γ
        solve(states_, s, decomposition_.halo[s], plan(), workspace);
        break;
    default:
        // Γ moves to the centroids of its neighbours, if it is corrected
        finish(s, workspace);
    }
    (kind == TaskKind::Accept ? state.seconds.correct : state.seconds.solve) += watch.lap();
}

/// Ends the work of sub-mesh s on a solution: measures its error, and accepts it; if the step has several solutions,
/// only fetches its halo.
void SweepStepper::finish(Index s, SolverWorkspace& workspace)
{
    const auto solution = states_[s].solution;
    if (error_ && solution != SubMeshState::Solution::OfData)
        error_->measure(states_, s, workspace);
    if (solution == SubMeshState::Solution::Only)
        accept_solution(s);
    else
        receive_solution(states_, s, decomposition_.halo[s]);
}

/// The array of a sub-mesh's state whose rows a message of this kind has.
Points& SweepStepper::rows_of(MessageKind kind, Index s)
{
    switch (kind) {
    case MessageKind::Position:
        return states_[s].position;
    case MessageKind::Prediction:
        return states_[s].predicted;
    default:
        return states_[s].solved;
    }
}

/// Runs the tasks of one sweep; with several ranks, sends the positions of own sub-meshes first.
/// @param sweep the number of the plan. @param join is called after all tasks.
void SweepStepper::run_sweep(std::size_t sweep, const std::function<void()>& join)
{
    sweep_ = sweep;
    if (remote_ == nullptr)
        return graph_.run(sweep, 0.0, join);
    const auto send_positions = [&] {
        for (Index s = 0; s < static_cast<Index>(states_.size()); ++s)
            if (is_own(s))
                remote_->send(MessageKind::Position, sweep, s, states_[s].position);
    };
    remote_->run(graph_, sweep, send_positions, join);
}

/// Accepts Vᵏ⁺¹ in sub-mesh s, corrected on Γ if the flow corrects it, and records the correction for the estimate.
void SweepStepper::accept_solution(Index s)
{
    corrects_ ? accept_corrected(states_, s, decomposition_.halo[s]) : accept(states_[s]);
    if (error_)
        error_->note_correction(states_, s);
}

/// Takes a step. The same graph is run once for each solution.
void SweepStepper::step(const Points& before)
{
    const std::size_t root = static_cast<std::size_t>(steps_done_) % plans_.size();
    const auto end = [&] {
        ++steps_done_;
        join();
    };
    if (filter_.is_plain())
        run_sweep(root, end);
    else
        take_filtered(root, end);
    if (error_)
        error_->add_step(states_, before);
}

/// Takes a step with a filter of several solutions, one sweep for each; then calls end(). Each sub-mesh filters its
/// halo, too, so that all sub-meshes at a vertex compute the same bits.
void SweepStepper::take_filtered(std::size_t root, const std::function<void()>& end)
{
    const auto for_each_own = [&](auto&& action) {
        for_each(run_in_parallel, static_cast<Index>(states_.size()), [&](Index s) {
            if (is_own(s))
                action(s, states_[s]);
        });
    };
    begin_solution(SubMeshState::Solution::First);
    run_sweep(root);
    PointBlocks rest(states_.size(), Points(0, 3));
    PointBlocks solution = rest;
    for_each_own([&](Index s, const SubMeshState& state) { rest[s] = state.position - state.solved; });
    begin_solution(SubMeshState::Solution::OfData);
    apply_filter(
        filter_, rest,
        [&](const PointBlocks& data) -> const PointBlocks& {
            for_each_own([&](Index s, SubMeshState& state) { state.data = data[s]; });
            run_sweep(root);
            for_each_own([&](Index s, const SubMeshState& state) { solution[s] = state.solved; });
            return solution;
        },
        run_in_parallel);
    for_each_own([&](Index s, SubMeshState& state) {
        Stopwatch watch;
        state.solved = state.position - rest[s];
        state.factor.reset();
        accept_solution(s);
        state.seconds.correct += watch.lap();
    });
    end();
}

/// Tells all sub-meshes which solution of the step the next sweep computes: the first, from Vᵏ, or a further one, from
/// SubMeshState::data.
void SweepStepper::begin_solution(SubMeshState::Solution solution)
{
    for (SubMeshState& state : states_)
        state.solution = solution;
}

/// Joins the positions of the sub-meshes to those of the mesh; copies of Γ are represented by their mean.
void SweepStepper::join()
{
    for_each(run_in_parallel, static_cast<Index>(states_.size()), [&](Index s) {
        const SubMesh& sub_mesh = *states_[s].sub_mesh;
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            if (sub_mesh.owned[v] != 0)
                positions_.row(sub_mesh.local_to_global[v]) = states_[s].position.row(v);
    });
    if (copies_)
        copies_->join(states_, positions_);
}

/// Copies the positions of the whole mesh to a sub-mesh.
void SweepStepper::fetch_positions(SubMeshState& state)
{
    for (Index v = 0; v < state.sub_mesh->n_vertices; ++v)
        state.position.row(v) = positions_.row(state.sub_mesh->local_to_global[v]);
}

/// If copies differ, each of them is mapped; their means are then those of the image up to rounding.
void SweepStepper::set_positions(const Points& image, const SimilarityOfComponents& similarity)
{
    copy(run_in_parallel, image, positions_);
    for_each(run_in_parallel, static_cast<Index>(states_.size()), [&](Index s) {
        SubMeshState& state = states_[s];
        if (!has_copies())
            return fetch_positions(state);
        for (Index v = 0; v < state.sub_mesh->n_vertices; ++v)
            state.position.row(v) = similarity(state.sub_mesh->local_to_global[v], state.position.row(v));
    });
    if (has_copies())
        join();
}

void SweepStepper::set_vertices(std::span<const Index> vertices, const Points& to)
{
    move_rows(vertices, to, positions_);
    std::vector<std::uint8_t> moves(usize(static_cast<Index>(positions_.rows())), 0);
    for (const Index v : vertices)
        if (v >= 0)
            moves[v] = 1;
    for_each(run_in_parallel, static_cast<Index>(states_.size()), [&](Index s) {
        const SubMesh& sub_mesh = *states_[s].sub_mesh;
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            if (const Index global = sub_mesh.local_to_global[v]; moves[global] != 0)
                states_[s].position.row(v) = positions_.row(global);
    });
}

/// Sub-meshes are saved only if their copies differ: otherwise they hold no more than the whole mesh.
void SweepStepper::save(StepMemory& memory) const
{
    memory.positions = positions_;
    memory.numbers = {static_cast<double>(steps_done_)};
    for (const SubMeshState& state : states_)
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
    positions_ = memory.positions;
    steps_done_ = reader.count();
    for (SubMeshState& state : states_) {
        const Index n_vertices = state.sub_mesh->n_vertices;
        if (has_copies())
            state.position.topRows(n_vertices) = reader.array(n_vertices);
        else
            fetch_positions(state);
    }
    if (error_)
        error_->restore(reader);
    reader.require_end();
    join();
}

void SweepStepper::add_seconds(PhaseSeconds& seconds) const
{
    for (const SubMeshState& state : states_)
        seconds.add_tasks(state.seconds);
}

void SweepStepper::report_to(StepReport& report) const
{
    if (copies_)
        report.gap = copies_->gap();
    if (error_)
        report.estimated_v_max = error_->largest();
}

void SweepStepper::report_to(FlowReport& report) const
{
    const std::vector<Index>& stage = plans_.front().stage;
    report.cut.interface_vertices = decomposition_.n_interface_vertices;
    report.resources.live_factors = windows_.front().size;
    report.resources.factor_memory_bytes = factors_->bytes();
    for (std::size_t s = 0; s < states_.size(); ++s)
        if (const SubMeshState& state = states_[s]; state.system)
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
