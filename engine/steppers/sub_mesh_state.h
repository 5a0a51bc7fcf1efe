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

/// The state of one sub-mesh. Of the others it sees only what transfers bring: the tasks below read the states of the
/// senders that a Transfer names, and write only to their own.
struct SubMeshState {
    SubMeshState(const SubMesh& sub_mesh, std::unique_ptr<SubMeshSystem> system, const Points& positions,
                 bool predicts);

    const SubMesh* sub_mesh;
    std::unique_ptr<SubMeshSystem> system;
    /// From assemble_and_factorise until solved.
    std::optional<SubMeshSystem::Factor> factor;
    /// Robin parameter, in 1/length.
    double p = 0.0;
    /// #local by 3, own vertices, then halo: Vᵏ at the beginning of a step, Vᵏ⁺¹ at its end.
    Points position;
    /// #local by 3: Vᵏ⁺¹ as solved, before the correction.
    Points solved;
    /// #local by 3: at own vertices, the result with Γ held at Vᵏ; empty where sub-meshes do not predict.
    Points predicted = Points(0, 3);
    /// Which solution of the step is being computed: with a filter that has several, the first, or the result for
    /// `data`.
    enum class Solution { Only, First, OfData } solution = Solution::Only;
    /// #local by 3: input of the step besides Vᵏ.
    Points data = Points(0, 3);
    /// Of its tasks in all steps.
    PhaseSeconds seconds;

    /// The input of the right-hand side.
    [[nodiscard]] const Points& given() const { return solution == Solution::OfData ? data : position; }
};

/// The mean of all copies of the i-th vertex of a sub-mesh's Γ.
/// @param array that the copies are rows of.
Point mean_of_copies(const std::vector<SubMeshState>& states, const SubMeshInterface& interface, Index i,
                     Points SubMeshState::*array);

/// Fetches Vᵏ for the halo, and in a mutual sweep the copies that the others have of Γ, fills the equations and
/// factorises them. Adds its seconds, which those of the others are not.
/// @param memory must outlive the states.
void assemble_and_factorise(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo,
                            const SweepPlan& plan, double time_step, FactorMemory& memory, SolverWorkspace& workspace);

/// Solves with Γ held at Vᵏ.
void predict(SubMeshState& state, SolverWorkspace& workspace);

/// Fetches what the sub-meshes beyond Γ predict, where this one leads.
void use_predictions(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& predictions,
                     SolverWorkspace& workspace);

/// Fetches Vᵏ⁺¹ where the sub-mesh follows another on its interface, keeps Vᵏ where it follows none, and solves. In a
/// mutual sweep it fetches the others' copies of Γ and the halo: Vᵏ⁺¹ from the sub-meshes of an earlier stage, and Vᵏ
/// from those of a later stage; where a vertex has several other copies, their mean is taken. The factor is freed if
/// the step has one solution.
void solve(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo, const SweepPlan& plan,
           SolverWorkspace& workspace);

/// Fetches Vᵏ⁺¹, as solved, for the halo.
void receive_solution(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo);

/// Accepts Vᵏ⁺¹ as it was solved.
void accept(SubMeshState& state);

/// Fetches Vᵏ⁺¹ for the halo, unless it already has all solutions, and accepts Vᵏ⁺¹, with vertices of Γ moved to the
/// centroids of their edge neighbours (paper, eq. 28). Every sub-mesh at a vertex finds the same bits.
void accept_corrected(std::vector<SubMeshState>& states, Index s, const std::vector<Transfer>& halo);

}  // namespace seamflow
