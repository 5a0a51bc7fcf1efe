#include "engine/sub_mesh_state.h"

#include "engine/stopwatch.h"

namespace seamflow {

namespace {

/// Carries rows of one array of the senders into the receiver's.
void receive(const std::vector<SubMeshState>& states, const std::vector<Transfer>& transfers,
             Points SubMeshState::*array, Points& target)
{
    for (const Transfer& transfer : transfers) {
        const Points& source = states[at(transfer.from)].*array;
        for (std::size_t i = 0; i < transfer.source.size(); ++i)
            target.row(transfer.target[i]) = source.row(transfer.source[i]);
    }
}

}  // namespace

SubMeshState::SubMeshState(const SubMesh& mesh, Laplacian laplacian, std::unique_ptr<TransmissionCondition> condition,
                           const Points& positions)
    : sub_mesh(&mesh)
    , system(mesh, laplacian, std::move(condition))
    , position(mesh.n_vertices + mesh.n_halo, 3)
    , solved(mesh.n_vertices + mesh.n_halo, 3)
{
    for (std::size_t i = 0; i < mesh.local_to_global.size(); ++i)
        position.row(static_cast<Eigen::Index>(i)) = positions.row(mesh.local_to_global[i]);
    solved = position;
}

void assemble_and_factorise(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo,
                            std::span<const InterfaceRole> roles, double time_step)
{
    SubMeshState& state = states[at(s)];
    Stopwatch watch;
    receive(states, halo, &SubMeshState::position, state.position);
    state.system.assemble(state.position, time_step, state.p, roles);
    state.seconds.assemble += watch.lap();
    state.system.factorise();
    state.seconds.factorise += watch.lap();
}

void predict(std::vector<SubMeshState>& states, Index s)
{
    SubMeshState& state = states[at(s)];
    Stopwatch watch;
    state.predicted.resize(state.position.rows(), 3);
    state.system.predict(state.position, state.predicted);
    state.seconds.solve += watch.lap();
}

void use_predictions(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& predictions)
{
    SubMeshState& state = states[at(s)];
    Stopwatch watch;
    state.other_side = state.position;
    receive(states, predictions, &SubMeshState::predicted, state.other_side);
    state.system.use_prediction(state.position, state.other_side);
    state.seconds.solve += watch.lap();
}

void solve(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& traces)
{
    SubMeshState& state = states[at(s)];
    Stopwatch watch;
    for (const Index v : state.sub_mesh->interface.vertices)
        state.solved.row(v) = state.position.row(v);
    receive(states, traces, &SubMeshState::solved, state.solved);
    state.system.solve(state.solved);
    state.seconds.solve += watch.lap();
}

void accept(std::vector<SubMeshState>& states, Index s)
{
    SubMeshState& state = states[at(s)];
    Stopwatch watch;
    state.position.topRows(state.sub_mesh->n_vertices) = state.solved.topRows(state.sub_mesh->n_vertices);
    state.seconds.correct += watch.lap();
}

void accept_corrected(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo)
{
    accept(states, s);
    SubMeshState& state = states[at(s)];
    Stopwatch watch;
    receive(states, halo, &SubMeshState::solved, state.solved);
    const auto& seam = state.sub_mesh->seam;
    for (Index i = 0; i < static_cast<Index>(seam.vertices.size()); ++i) {
        Point sum = Point::Zero();
        for (const Index neighbour : seam.neighbours[i])
            sum += state.solved.row(neighbour);
        state.position.row(seam.vertices[at(i)]) = sum / static_cast<double>(seam.neighbours[i].size());
    }
    state.seconds.correct += watch.lap();
}

}  // namespace seamflow
