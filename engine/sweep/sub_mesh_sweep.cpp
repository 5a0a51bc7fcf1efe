#include "engine/sweep/sub_mesh_sweep.h"

#include <algorithm>
#include <memory_resource>
#include <span>
#include <utility>
#include <variant>

#include "engine/sweep/sub_mesh_equations.h"
#include "engine/sweep/sweep_order.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/decomposition/make_sub_mesh.h"
#include "partition/decomposition/overlap.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// The sub-meshes of a cut, grown into each other by layers of faces, for a sweep in ascending order of `stage`.
Decomposition overlap_sub_meshes(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                 std::span<const Index> stage, int layers)
{
    const Overlap overlap{cut.labels, stage, layers};
    auto faces = faces_by_label(cut.labels, cut.n_parts, run_in_parallel);
    std::vector<SubMesh> sub_meshes(faces.size());
    for_each(run_in_parallel, static_cast<Index>(faces.size()), [&](Index s) {
        sub_meshes[s] = make_overlapping_sub_mesh(mesh, topology, overlap, s, std::move(faces[s]));
    });
    return connect_overlapping(std::move(sub_meshes), topology, overlap);
}

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

/// Fetches the other side of a sub-mesh with a copy of Γ: the halo, and on Γ the mean of the other sub-meshes' copies.
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

SweepSubMeshes cut_out(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const SweepSteps& sweeps,
                       std::vector<double> curvature, Progress& progress)
{
    SweepSubMeshes all{
        .decomposition = decompose(mesh, topology, cut.labels, cut.n_parts, progress.exec()), .names = {}, .stage = {}};
    all.names = names_of(all.decomposition);
    all.stage = assign_stages(all.decomposition.adjacency, sweeps.solves_in_order_of_numbers,
                              total_curvatures(all.decomposition, std::exchange(curvature, {})));
    if (const auto* const schwarz = std::get_if<SchwarzConditions>(&sweeps.conditions))
        all.decomposition = overlap_sub_meshes(mesh, topology, cut, all.stage, schwarz->overlap);
    progress.require_going_on();
    return all;
}

SubMeshSweep::SubMeshSweep(const PolygonMesh& mesh, SweepSubMeshes sub_meshes, const StepSettings& settings,
                           const SweepSteps& sweeps, Workspaces& workspaces, Progress& progress)
    : decomposition_(std::move(sub_meshes.decomposition))
    , names_(std::move(sub_meshes.names))
    , states_(decomposition_.sub_meshes.size())
    , time_step_(settings.equation.time_step)
    , predicts_(seamflow::predict(sweeps.conditions))
    , corrects_(sweeps.corrects)
{
    copy(run_in_parallel, mesh.vertices, positions_);
    if (const auto* const classical = std::get_if<ClassicalConditions>(&sweeps.conditions))
        gaps_.emplace(mesh, decomposition_, classical->keeps_gaps);
    progress.expect(static_cast<double>(size()));
    for_each(run_in_parallel, size(), [&](Index s) {
        progress.require_going_on();
        SubMesh& sub_mesh = decomposition_.sub_meshes[s];
        SubMeshState& state = states_[s];
        state.sub_mesh = &sub_mesh;
        state.position.resize(sub_mesh.n_vertices + sub_mesh.n_halo, 3);
        for (std::size_t i = 0; i < sub_mesh.local_to_global.size(); ++i)
            state.position.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(sub_mesh.local_to_global[i]);
        state.solution = state.position;
        if (predicts_)
            state.predicted.resize(state.position.rows(), 3);
        if (!sub_meshes.is_remote.empty() && sub_meshes.is_remote[s] != 0)
            return;
        run_for_sub_mesh(names_[s], [&] {
            state.system = make_equations(sub_mesh, std::move(sub_mesh.twin), size() == 1, settings, sweeps.conditions,
                                          workspaces.local());
            state.p = robin_parameter(sub_mesh, state.position, sweeps.conditions, time_step_);
            if (!state.system->uses_faces())
                keep_faces_at_interface(sub_mesh);
        });
        progress.count();
    });
    plans_.push_back(make_plan(decomposition_, sweeps.conditions, sub_meshes.stage));
    if (sweeps.alternates)
        plans_.push_back(make_plan(decomposition_, sweeps.conditions, reversed(sub_meshes.stage)));
}

SubMeshSystem::Assembled SubMeshSweep::assemble(Index s, SolverWorkspace& workspace)
{
    SubMeshState& state = states_[s];
    const std::vector<Transfer>& halo = decomposition_.halo[s];
    const std::vector<Transfer>& copies = plan().copies[s];
    receive(states_, halo, &SubMeshState::position, state.position);
    if (!copies.empty())
        receive_other_side(
            states_, halo, copies, [](Index) { return &SubMeshState::position; }, state, workspace.other_side);
    return state.system->assemble(state.position, copies.empty() ? state.position : workspace.other_side, time_step_,
                                  state.p, plan().roles[s], workspace);
}

void SubMeshSweep::factorise(Index s, const SubMeshSystem::Assembled& equations, FactorMemory& memory,
                             SolverWorkspace& workspace)
{
    SubMeshState& state = states_[s];
    // A failed step may have left a factor.
    state.factor.reset();
    state.factor = state.system->factorise(equations, memory, workspace);
}

void SubMeshSweep::predict(Index s, SolverWorkspace& workspace)
{
    SubMeshState& state = states_[s];
    for (const Index v : state.sub_mesh->interface.vertices)
        state.predicted.row(v) = state.given().row(v);
    state.system->solve(*state.factor, state.given(), state.predicted, workspace);
}

void SubMeshSweep::use_predictions(Index s, SolverWorkspace& workspace)
{
    SubMeshState& state = states_[s];
    copy(state.given(), workspace.other_side);
    receive(states_, plan().predictions[s], &SubMeshState::predicted, workspace.other_side);
    state.system->use_other_side(state.given(), workspace.other_side);
}

void SubMeshSweep::solve(Index s, SolverWorkspace& workspace)
{
    SubMeshState& state = states_[s];
    const std::vector<Transfer>& copies = plan().copies[s];
    if (copies.empty()) {
        for (const Index v : state.sub_mesh->interface.vertices)
            state.solution.row(v) = state.given().row(v);
        receive(states_, plan().traces[s], &SubMeshState::solution, state.solution);
    } else {
        const auto latest = [&](Index t) {
            return plan().stage[t] < plan().stage[s] ? &SubMeshState::solution : &SubMeshState::position;
        };
        receive_other_side(states_, decomposition_.halo[s], copies, latest, state, workspace.other_side);
        state.system->use_other_side(state.position, workspace.other_side);
    }
    // On Γ, `solution` now has Vᵏ⁺¹ where the sub-mesh follows.
    state.system->solve(*state.factor, state.given(), state.solution, workspace);
}

void SubMeshSweep::receive_solutions(Index s)
{
    receive(states_, decomposition_.halo[s], &SubMeshState::solution, states_[s].solution);
}

void SubMeshSweep::accept(Index s)
{
    SubMeshState& state = states_[s];
    const Index n = state.sub_mesh->n_vertices;
    state.position.topRows(n) = state.solution.topRows(n);
    if (!corrects_)
        return;
    const auto& corrected = state.sub_mesh->corrected;
    for (Index i = 0; i < static_cast<Index>(corrected.vertices.size()); ++i) {
        Point sum = Point::Zero();
        for (const Index neighbour : corrected.neighbours[i])
            sum += state.solution.row(neighbour);
        state.position.row(corrected.vertices[i]) = sum / static_cast<double>(corrected.neighbours[i].size());
    }
}

void SubMeshSweep::join()
{
    for_each(run_in_parallel, size(), [&](Index s) {
        const SubMesh& sub_mesh = *states_[s].sub_mesh;
        for (Index v = 0; v < sub_mesh.n_vertices; ++v)
            if (sub_mesh.owned[v] != 0)
                positions_.row(sub_mesh.local_to_global[v]) = states_[s].position.row(v);
    });
    if (gaps_)
        gaps_->join(states_, positions_);
}

void take_step(SubMeshSweep& sweep, SolverWorkspace& workspace)
{
    const auto for_all = [&](auto&& action) {
        for (Index s = 0; s < sweep.size(); ++s)
            run_for_sub_mesh(sweep.name(s), [&] { action(s); });
    };
    const SweepPlan& plan = sweep.plan();
    const Index last_turn = plan.stage.empty() ? -1 : *std::ranges::max_element(plan.stage);
    for_all([&](Index s) {
        // A = I + dt Δ(Vᵏ), on Γ the condition or the identity
        const SubMeshSystem::Assembled equations = sweep.assemble(s, workspace);
        // A = L U
        sweep.factorise(s, equations, *std::pmr::new_delete_resource(), workspace);
    });
    for_all([&](Index s) {
        // A x = Vᵏ, with x = Vᵏ on Γ
        if (sweep.predicts() && !plan.traces[s].empty())
            sweep.predict(s, workspace);
    });
    for (Index turn = 0; turn <= last_turn; ++turn)
        for_all([&](Index s) {
            if (plan.stage[s] != turn)
                return;
            // b = Vᵏ, on Γ the condition with x beyond it
            if (sweep.predicts() && !plan.predictions[s].empty())
                sweep.use_predictions(s, workspace);
            // A Vᵏ⁺¹ = b, with the Vᵏ⁺¹ on Γ of sub-meshes that have solved
            sweep.solve(s, workspace);
            sweep.states()[s].factor.reset();
        });
    for_all([&](Index s) { sweep.receive_solutions(s); });
    // Γ to the centroids of its neighbours, if it is corrected
    for_all([&](Index s) { sweep.accept(s); });
    sweep.join();
}

void SubMeshSweep::fetch_positions(Index s)
{
    SubMeshState& state = states_[s];
    for (Index v = 0; v < state.sub_mesh->n_vertices; ++v)
        state.position.row(v) = positions_.row(state.sub_mesh->local_to_global[v]);
}

}  // namespace seamflow
