#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/executor.h"
#include "solvers/conditions/transmission_condition.h"
#include "solvers/direct/direct_solver.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/laplacian.h"
#include "solvers/systems/interface_role.h"

namespace seamflow {

/// The equations of one backward Euler step on one sub-mesh, one per own vertex:
///   fixed vertices       V^{k+1} = V^k
///   Γ, following         V^{k+1} = the result of the leading sub-mesh
///   Γ, leading           the transmission condition
///   all others           (I + dt Δ) V^{k+1} = V^k, Δ from the sub-mesh's own faces
///
/// In the last two, an attachment to V⁰ (FlowTerms) adds dt w to the diagonal and dt w V⁰ to the right-hand side. The
/// equations are analysed once; each step refills their values. The workspace may differ between calls. Different
/// systems may be used by different threads at the same time, each with a workspace of its own.
class SubMeshSystem {
  public:
    virtual ~SubMeshSystem() = default;

    /// The matrix of a step, in the system or in a workspace. It is valid until this system assembles again, or another
    /// one with the same workspace.
    struct Assembled {
        std::span<double> matrix;
    };
    using Factor = DirectSolver::Factor;

    /// Assembles the equations for Vᵏ.
    /// @param positions #local by 3, the halo included: Vᵏ.
    /// @param other_side #local by 3: Vᵏ of the sub-meshes beyond Γ, on Γ and in the halo. The same as `positions`
    ///        unless every sub-mesh has its own copy of Γ.
    /// @param time_step dt, in length².
    /// @param p Robin parameter, in 1/length.
    /// @param roles one per vertex of Γ.
    [[nodiscard]] virtual Assembled assemble(const Points& positions, const Points& other_side, double time_step,
                                             double p, std::span<const InterfaceRole> roles,
                                             SolverWorkspace& workspace) = 0;

    /// Size of a factor, in bytes; an estimate if not known beforehand.
    [[nodiscard]] virtual std::size_t factor_bytes() const = 0;

    /// Whether the system needs the faces of the sub-mesh after its construction.
    [[nodiscard]] virtual bool uses_faces() const { return true; }

    /// Kind of the factorisation (see DirectSolver::kind).
    [[nodiscard]] virtual Factorisation factorisation() const = 0;

    /// Factorises the matrix of a step.
    /// @param memory must outlive the factor, as must the system.
    /// @throws ComputationError if the equations are singular or not finite.
    [[nodiscard]] virtual Factor factorise(const Assembled& equations, FactorMemory& memory,
                                           SolverWorkspace& workspace) = 0;

    /// The number of factorisations so far whose equations were nearly singular: their solutions have three correct
    /// digits at most.
    [[nodiscard]] virtual Index n_nearly_singular() const { return 0; }

    /// Replaces Vᵏ on the right-hand side by D, without the attachment to V⁰: the functions below then take D in place
    /// of Vᵏ, and solve for the result of the step applied to D, with the same factor.
    /// @param data #local by 3: D, which is 0 at fixed vertices.
    virtual void use_data(const Points& data) = 0;

    /// Updates the right-hand side at vertices of Γ where the sub-mesh leads.
    /// @param positions #local by 3: Vᵏ.
    /// @param other_side #local by 3: the latest known Vᵏ⁺¹ of the sub-meshes beyond Γ, on Γ and in the halo.
    virtual void use_other_side(const Points& positions, const Points& other_side) = 0;

    /// Solves for Vᵏ⁺¹. If the given positions where the sub-mesh follows are Vᵏ, the result is a prediction: Vᵏ⁺¹ if
    /// the sub-meshes around did not move.
    /// @param positions #local by 3: Vᵏ.
    /// @param solution #local by 3. In: Vᵏ⁺¹ at those vertices of Γ where the sub-mesh follows. Out: Vᵏ⁺¹ at all own
    ///        vertices; where the sub-mesh follows, and at fixed vertices, bitwise the given values.
    /// @throws ComputationError if the result is not finite.
    virtual void solve(const Factor& factor, const Points& positions, Points& solution, SolverWorkspace& workspace) = 0;
};

/// The data from which a system is constructed.
struct SystemParts {
    /// The sub-mesh, which must outlive the system.
    const SubMesh& sub_mesh;
    /// SubMesh::twin. Only unsymmetric systems keep it, because it takes a twentieth of a flow's memory.
    std::vector<Index> twin;
    ScaledLaplacian laplacian;
    Factorisation factorisation = Factorisation::Automatic;
    FlowTerms terms = {};
    /// Runs loops of this sub-mesh on several threads; empty: everything runs on the calling thread.
    Executor exec = {};
};

/// The equations with a condition of any kind on Γ. The condition is not used if Γ is empty.
/// @throws ComputationError if the analysis fails.
std::unique_ptr<SubMeshSystem> make_system(SystemParts parts, std::unique_ptr<TransmissionCondition> condition,
                                           SolverWorkspace& workspace);

/// The equations where the other side is predicted (see predicted_side.h).
std::unique_ptr<SubMeshSystem> make_predicted_system(SystemParts parts, SolverWorkspace& workspace);

/// The equations of a sub-mesh that follows everywhere on its Γ, which may be empty.
std::unique_ptr<SubMeshSystem> make_following_system(SystemParts parts, SolverWorkspace& workspace);

}  // namespace seamflow
