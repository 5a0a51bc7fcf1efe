#include "engine/steppers/sub_mesh_state.h"

#include "engine/tasks/stopwatch.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

void copy(const Points& source, Points& target)
{
    set_rows(target, source.rows());
    target = source;
}

/// Copies the rows of transfers, in one array of the senders' states, to `target`.
void receive(const std::vector<SubMeshState>& states, std::span<const Transfer> transfers, Points SubMeshState::*array,
             Points& target)
{
    for (const Transfer& transfer : transfers) {
        const Points& source = states[transfer.from].*array;
        for (std::size_t i = 0; i < transfer.source.size(); ++i)
            target.row(transfer.target[i]) = source.row(transfer.source[i]);
    }
}

/// Fetches the other side of a sub-mesh of a mutual sweep: the halo, and on Γ the mean of the other sub-meshes' copies.
/// @param array_of array_of(t) is the array of the state of sub-mesh t that is read.
/// @param other_side #local by 3: receives the rows.
template <class ArrayOf>
void receive_other_side(const std::vector<SubMeshState>& states, const std::vector<Transfer>& halo,
                        const std::vector<Transfer>& copies, ArrayOf array_of, const SubMeshState& state,
                        Points& other_side)
{
    copy(state.position, other_side);
    for (const Transfer& transfer : halo)
        receive(states, std::span(&transfer, 1), array_of(transfer.from), other_side);
    const auto& interface = state.sub_mesh->interface;
    for (const Index v : interface.vertices)
        other_side.row(v).setZero();
    for (const Transfer& transfer : copies) {
        const Points& source = states[transfer.from].*array_of(transfer.from);
        for (std::size_t i = 0; i < transfer.source.size(); ++i)
            other_side.row(transfer.target[i]) += source.row(transfer.source[i]);
    }
    // `sharing` has this sub-mesh, too, whose own copy is not in the sum.
    for (Index i = 0; i < interface.size(); ++i)
        other_side.row(interface.vertices[i]) /= static_cast<double>(interface.sharing[i].size() - 1);
}

}  // namespace

SubMeshState::SubMeshState(const SubMesh& mesh, std::unique_ptr<SubMeshSystem> equations, const Points& positions,
                           bool predicts)
    : sub_mesh(&mesh)
    , system(std::move(equations))
    , position(mesh.n_vertices + mesh.n_halo, 3)
    , solved(mesh.n_vertices + mesh.n_halo, 3)
{
    for (std::size_t i = 0; i < mesh.local_to_global.size(); ++i)
        position.row(static_cast<Eigen::Index>(i)) = positions.row(mesh.local_to_global[i]);
    solved = position;
    if (predicts)
        predicted.resize(position.rows(), 3);
}

Point mean_of_copies(const std::vector<SubMeshState>& states, const SubMeshInterface& interface, Index i,
                     Points SubMeshState::*array)
{
    Point sum = Point::Zero();
    for (std::size_t k = 0; k < interface.sharing[i].size(); ++k)
        sum += (states[interface.sharing[i][k]].*array).row(interface.index_in_sharing[i][k]);
    return sum / static_cast<double>(interface.sharing[i].size());
}

void assemble_and_factorise(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo,
                            const SweepPlan& plan, double time_step, FactorMemory& memory, SolverWorkspace& workspace)
{
    SubMeshState& state = states[s];
    Stopwatch watch;
    receive(states, halo, &SubMeshState::position, state.position);
    const bool is_mutual = !plan.copies[s].empty();
    Points& other_side = workspace.other_side;
    if (is_mutual)
        receive_other_side(
            states, halo, plan.copies[s], [](Index) { return &SubMeshState::position; }, state, other_side);
    const auto equations = state.system->assemble(state.position, is_mutual ? other_side : state.position, time_step,
                                                  state.p, plan.roles[s], workspace);
    state.seconds.assemble += watch.lap();
    // A failed step may have left a factor.
    state.factor.reset();
    state.factor = state.system->factorise(equations, memory, workspace);
    state.seconds.factorise += watch.lap();
}

void predict(SubMeshState& state, SolverWorkspace& workspace)
{
    for (const Index v : state.sub_mesh->interface.vertices)
        state.predicted.row(v) = state.given().row(v);
    state.system->solve(*state.factor, state.given(), state.predicted, workspace);
}

void use_predictions(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& predictions,
                     SolverWorkspace& workspace)
{
    SubMeshState& state = states[s];
    copy(state.given(), workspace.other_side);
    receive(states, predictions, &SubMeshState::predicted, workspace.other_side);
    state.system->use_other_side(state.given(), workspace.other_side);
}

void solve(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo, const SweepPlan& plan,
           SolverWorkspace& workspace)
{
    SubMeshState& state = states[s];
    if (plan.copies[s].empty()) {
        for (const Index v : state.sub_mesh->interface.vertices)
            state.solved.row(v) = state.given().row(v);
        receive(states, plan.traces[s], &SubMeshState::solved, state.solved);
    } else {
        const auto latest = [&](Index t) {
            return plan.stage[t] < plan.stage[s] ? &SubMeshState::solved : &SubMeshState::position;
        };
        receive_other_side(states, halo, plan.copies[s], latest, state, workspace.other_side);
        state.system->use_other_side(state.position, workspace.other_side);
    }
    // On Γ `solved` now has Vᵏ⁺¹ where the sub-mesh follows.
    state.system->solve(*state.factor, state.given(), state.solved, workspace);
    if (state.solution == SubMeshState::Solution::Only)
        state.factor.reset();
}

void receive_solution(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo)
{
    receive(states, halo, &SubMeshState::solved, states[s].solved);
}

void accept(SubMeshState& state)
{
    state.position.topRows(state.sub_mesh->n_vertices) = state.solved.topRows(state.sub_mesh->n_vertices);
}

void accept_corrected(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo)
{
    SubMeshState& state = states[s];
    accept(state);
    if (state.solution == SubMeshState::Solution::Only)
        receive_solution(states, s, halo);
    const Points& result = state.solved;
    const auto& corrected = state.sub_mesh->corrected;
    for (Index i = 0; i < static_cast<Index>(corrected.vertices.size()); ++i) {
        Point sum = Point::Zero();
        for (const Index neighbour : corrected.neighbours[i])
            sum += result.row(neighbour);
        state.position.row(corrected.vertices[i]) = sum / static_cast<double>(corrected.neighbours[i].size());
    }
}

}  // namespace seamflow
