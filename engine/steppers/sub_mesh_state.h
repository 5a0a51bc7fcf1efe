#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/setup/sweep_plan.h"
#include "partition/decomposition/decomposition.h"
#include "solvers/systems/sub_mesh_system.h"

namespace seamflow {

/// The state of one sub-mesh. The tasks below read states of other sub-meshes only as far as a Transfer names their
/// rows, and write only to the state of their own sub-mesh.
struct SubMeshState {
    SubMeshState(const SubMesh& sub_mesh, std::unique_ptr<SubMeshSystem> system, const Points& positions,
                 bool predicts);

    const SubMesh* sub_mesh;
    std::unique_ptr<SubMeshSystem> system;
    /// Exists from assemble_and_factorise until the last solution of the step.
    std::optional<SubMeshSystem::Factor> factor;
    /// Robin parameter, in 1/length.
    double p = 0.0;
    /// #local by 3, own vertices, then halo: Vᵏ at the beginning of a step, Vᵏ⁺¹ at its end.
    Points position;
    /// #local by 3: Vᵏ⁺¹ as solved, before the correction.
    Points solved;
    /// #local by 3: at own vertices, the result with Γ fixed at Vᵏ; empty if sub-meshes do not predict.
    Points predicted = Points(0, 3);
    /// Which solution of the present step the present sweep computes: Only if the step has one; with a filter that
    /// needs several, First from Vᵏ, then OfData from `data`.
    enum class Solution { Only, First, OfData } solution = Solution::Only;
    /// #local by 3: the input of further solutions, in place of Vᵏ.
    Points data = Points(0, 3);
    /// The times of its tasks in all steps.
    PhaseSeconds seconds;

    /// The positions or data on the right-hand side.
    [[nodiscard]] const Points& given() const { return solution == Solution::OfData ? data : position; }
};

/// The mean over all copies of the i-th vertex of a sub-mesh's Γ.
/// @param array the copies are rows of this array of each state.
Point mean_of_copies(const std::vector<SubMeshState>& states, const SubMeshInterface& interface, Index i,
                     Points SubMeshState::*array);

/// Fetches Vᵏ for the halo, and in a mutual sweep (see plan_mutual_sweep) the other sub-meshes' copies of Γ; assembles
/// and factorises the equations. Adds its time to the seconds of the sub-mesh; the functions below do not.
/// @param memory must outlive the states.
void assemble_and_factorise(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo,
                            const SweepPlan& plan, double time_step, FactorMemory& memory, SolverWorkspace& workspace);

/// Solves with Γ fixed at Vᵏ.
void predict(SubMeshState& state, SolverWorkspace& workspace);

/// Fetches the predictions of the sub-meshes beyond Γ, where this sub-mesh leads.
void use_predictions(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& predictions,
                     SolverWorkspace& workspace);

/// Fetches Vᵏ⁺¹ where the sub-mesh follows another on its interface, takes Vᵏ where it follows none, and solves. In a
/// mutual sweep it fetches the other sub-meshes' copies of Γ and the halo: Vᵏ⁺¹ from sub-meshes of an earlier stage,
/// and Vᵏ from sub-meshes of a later stage; where a vertex has several other copies, their mean is used. The factor is
/// freed if the step has one solution.
void solve(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo, const SweepPlan& plan,
           SolverWorkspace& workspace);

/// Fetches Vᵏ⁺¹, as solved, for the halo.
void receive_solution(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo);

/// Accepts Vᵏ⁺¹ as it was solved.
void accept(SubMeshState& state);

/// Fetches Vᵏ⁺¹ for the halo, unless the step has several solutions, whose halo has been fetched already; and accepts
/// Vᵏ⁺¹, with vertices of Γ moved to the centroids of their edge neighbours (paper, eq. 28). Every sub-mesh at a vertex
/// finds the same bits.
void accept_corrected(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo);

}  // namespace seamflow
