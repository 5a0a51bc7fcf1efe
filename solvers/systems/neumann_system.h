#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/index_lists.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/systems/symmetric_matrix.h"

namespace seamflow {

/// A sub-mesh's share A = M + dt K of the whole backward Euler system, assembled from its own faces alone: summed over
/// the sub-meshes, the shares are the whole. Factorised with Γ last, A = L D Lᵀ solves the interior with Γ given, and
/// its last block is the sub-mesh's Schur complement on Γ (see SchurComplement). For Δ_F and Δ_A. One thread at a time.
class NeumannSystem {
  public:
    /// @param sub_mesh without overlap; needed only during the call.
    /// @param faces its face_vertices: most of what Δ_A keeps of it, while Δ_F has its edges.
    /// @throws ComputationError if the analysis fails.
    NeumannSystem(const SubMesh& sub_mesh, IndexLists faces, Laplacian laplacian);
    NeumannSystem(const NeumannSystem&) = delete;
    NeumannSystem& operator=(const NeumannSystem&) = delete;

    /// Number of vertices on Γ.
    [[nodiscard]] Index n_interface() const { return n_interface_; }

    /// Number of the other unknowns.
    [[nodiscard]] Index n_interior() const { return matrix_.n() - n_interface_; }

    /// The own vertices that may move, in the order of the solution's rows: the interior, then Γ in its own order.
    [[nodiscard]] const std::vector<Index>& unknowns() const { return matrix_.vertex_of; }

    /// What a factor takes, in bytes.
    [[nodiscard]] std::size_t factor_bytes() const { return solver_.factor_bytes(); }

    /// The equations A (Vᵏ⁺¹ - Vᵏ) = -dt K Vᵏ of a step, in a workspace: valid until that is used again.
    struct Assembled {
        std::span<const double> matrix;
        /// #local by 3: dt K Vᵏ.
        const Points& product;
    };

    /// @param positions at least #own by 3: Vᵏ.
    /// @param time_step dt, in length².
    [[nodiscard]] Assembled assemble(const Points& positions, double time_step, SolverWorkspace& workspace) const;

    /// @param memory must outlive the factor, as must the system.
    /// @throws ComputationError if the equations are singular or not finite.
    [[nodiscard]] LdlSolver::Factor factorise(const Assembled& equations, FactorMemory& memory,
                                              LdlWorkspace& workspace) const;

    /// Eliminates the interior from the equations.
    /// @param condensed #unknowns by 3. Receives what back_substitute needs of the interior, and then this sub-mesh's
    ///        share of the right-hand side on Γ.
    void condense(const Assembled& equations, const LdlSolver::Factor& factor, Points& condensed) const;

    /// Solves for the interior with Γ given.
    /// @param solution #unknowns by 3. In: what condense left of the interior, and Vᵏ⁺¹ - Vᵏ on Γ. Out: Vᵏ⁺¹ - Vᵏ.
    /// @throws ComputationError if the result is not finite.
    static void back_substitute(const LdlSolver::Factor& factor, Points& solution);

  private:
    SparsePattern number_unknowns(const SubMesh& sub_mesh);

    Index n_interface_;
    /// Where the Laplacian uses them.
    IndexLists faces_;
    SymmetricMatrix matrix_;
    LdlSolver solver_;
};

}  // namespace seamflow
