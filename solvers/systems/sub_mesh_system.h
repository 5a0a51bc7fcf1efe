#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "partition/decomposition/sub_mesh.h"
#include "partition/decomposition/sweep_plan.h"
#include "solvers/conditions/transmission_condition.h"
#include "solvers/direct/direct_solver.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// What a system looks at of its sub-mesh's own faces when it has been constructed. The rest may go.
enum class FacesInUse {
    None,
    /// SubMesh::face_vertices.
    Corners,
    /// SubMesh::twin as well.
    All,
};

/// The equations of one backward Euler step on one sub-mesh, one per own vertex:
///   fixed vertices       V^{k+1} = V^k
///   Γ, following         V^{k+1} = what the leading sub-mesh found
///   Γ, leading           the transmission condition
///   all others           (I + dt Δ) V^{k+1} = V^k, Δ from the sub-mesh's own faces
///
/// They are analysed once; each step fills in their values anew. The workspace may be another one in each call, but for
/// factorise, which takes over what assemble left in it. Different systems may be used by different threads at the same
/// time, each with a workspace of its own.
class SubMeshSystem {
  public:
    virtual ~SubMeshSystem() = default;

    /// Fills in all that follows from Vᵏ.
    /// @param positions #local by 3, the halo included: Vᵏ.
    /// @param other_side #local by 3: Vᵏ as the sub-meshes beyond Γ have it, on Γ and in the halo. The same as
    ///        `positions` but where every sub-mesh has a copy of Γ of its own.
    /// @param time_step dt, in length².
    /// @param p Robin parameter, in 1/length.
    /// @param roles one per vertex of Γ.
    virtual void assemble(const Points& positions, const Points& other_side, double time_step, double p,
                          std::span<const InterfaceRole> roles, SolverWorkspace& workspace) = 0;

    [[nodiscard]] virtual FacesInUse faces_in_use() const { return FacesInUse::All; }

    /// What a factor takes, in bytes; where that is not known beforehand, an estimate.
    [[nodiscard]] virtual std::size_t factor_bytes() const = 0;

    /// Whose the factorisation is (see DirectSolver::kind).
    [[nodiscard]] virtual Factorisation factorisation() const = 0;

    /// To be called after `assemble`, with the same workspace.
    /// @throws ComputationError if the equations are singular or not finite.
    virtual void factorise(SolverWorkspace& workspace) = 0;

    /// How many factorisations so far were of equations that are nearly singular: three correct digits at most.
    [[nodiscard]] virtual Index n_nearly_singular() const { return 0; }

    /// Solves with Γ held at Vᵏ where the sub-mesh follows: what it would do if nobody around moved.
    /// @param positions #local by 3: Vᵏ.
    /// @param prediction #local by 3; receives the result at own vertices.
    /// @throws ComputationError if the result is not finite.
    virtual void predict(const Points& positions, Points& prediction, SolverWorkspace& workspace) = 0;

    /// Takes account of the other side where the sub-mesh leads.
    /// @param positions #local by 3: Vᵏ.
    /// @param other_side #local by 3: what is known of Vᵏ⁺¹ beyond Γ, on Γ and in the halo.
    virtual void use_other_side(const Points& positions, const Points& other_side) = 0;

    /// Solves for Vᵏ⁺¹, then gives the factor's memory back.
    /// @param positions #local by 3: Vᵏ.
    /// @param solution #local by 3. In: Vᵏ⁺¹ at those vertices of Γ where the sub-mesh follows. Out: Vᵏ⁺¹ at all own
    ///        vertices; where it follows, and at fixed vertices, to the bit what was given.
    /// @throws ComputationError if the result is not finite.
    virtual void solve(const Points& positions, Points& solution, SolverWorkspace& workspace) = 0;
};

/// The equations with a condition of any kind on Γ.
/// @param sub_mesh must outlive the system.
/// @throws ComputationError if the analysis fails.
std::unique_ptr<SubMeshSystem> make_system(const SubMesh& sub_mesh, Laplacian laplacian,
                                           std::unique_ptr<TransmissionCondition> condition, SolverWorkspace& workspace,
                                           Factorisation factorisation = Factorisation::Automatic);

/// The equations where the other side is predicted (see predicted_side.h).
std::unique_ptr<SubMeshSystem> make_predicted_system(const SubMesh& sub_mesh, Laplacian laplacian,
                                                     SolverWorkspace& workspace,
                                                     Factorisation factorisation = Factorisation::Automatic);

/// The equations of a sub-mesh that follows everywhere on its Γ, which may be empty.
std::unique_ptr<SubMeshSystem> make_following_system(const SubMesh& sub_mesh, Laplacian laplacian,
                                                     SolverWorkspace& workspace,
                                                     Factorisation factorisation = Factorisation::Automatic);

}  // namespace seamflow
