#pragma once

#include <memory>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/direct/dense_factor.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/laplacian/symmetric_laplacian.h"
#include "solvers/systems/sub_mesh_system.h"
#include "solvers/systems/upper_pattern.h"

namespace seamflow {

/// A sub-mesh's share A = M + dt K of the whole backward Euler system, assembled from its own faces alone: summed over
/// the sub-meshes, the shares are the whole. Factorised once with Γ last, A = L D Lᵀ solves the interior with Γ given,
/// and its last block is the sub-mesh's Schur complement on Γ, S = L_Γ D_Γ L_Γᵀ.
/// For Δ_F and Δ_A.
class NeumannSystem {
  public:
    /// @param sub_mesh must outlive the system; without overlap.
    /// @throws ComputationError if the analysis fails.
    NeumannSystem(const SubMesh& sub_mesh, Laplacian laplacian);

    [[nodiscard]] FacesInUse faces_in_use() const
    {
        return laplacian_->uses_faces() ? FacesInUse::Corners : FacesInUse::None;
    }

    /// Number of vertices on Γ.
    [[nodiscard]] Index n_interface() const { return sub_mesh_->interface.size(); }

    /// Number of the other unknowns.
    [[nodiscard]] Index n_interior() const { return static_cast<Index>(vertex_of_.size()) - n_interface(); }

    /// Fills in A, and dt K Vᵏ.
    /// @param positions at least #own by 3: Vᵏ.
    /// @param time_step dt, in length².
    void assemble(const Points& positions, double time_step, SolverWorkspace& workspace);

    /// To be called after `assemble`, with the same workspace. The factor's memory is the system's own, kept from step
    /// to step, unless it is borrowed.
    /// @throws ComputationError if the equations are singular or not finite.
    void factorise(SolverWorkspace& workspace);

    /// From now on the factor is in memory of the workspace's, and lives twice in each step: from `factorise` until it
    /// is given back after `condense`, and from `factorise_again` until it is given back after `fill_in`.
    void borrow_memory() { borrows_memory_ = true; }

    /// Gives borrowed memory back. What the equation on Γ needs of the factor stays until the next `factorise`.
    void give_back_interior(SolverWorkspace& workspace);

    /// For `fill_in`, after `assemble` with the same positions.
    void factorise_again(SolverWorkspace& workspace);

    /// Gives borrowed memory back.
    void give_back(SolverWorkspace& workspace);

    /// Eliminates the interior from A (Vᵏ⁺¹ - Vᵏ) = -dt K Vᵏ. To be called after `assemble` and a factorisation,
    /// with the same workspace: it has K Vᵏ.
    /// @param eliminated #unknowns by 3: receives what fill_in needs of it.
    /// @param condensed n_interface() by 3: receives this sub-mesh's share of the right-hand side on Γ.
    void condense(Points& eliminated, Eigen::Ref<Points> condensed, const SolverWorkspace& workspace) const;

    /// The Schur complement on Γ.
    [[nodiscard]] const DenseFactor& schur() const { return schur_; }

    /// result -= S x in double precision, straight from the factor, or from what of it stays.
    /// @param x, result n_interface() by 3.
    void subtract_schur(const Eigen::Ref<const Points>& x, Eigen::Ref<Points> result) const;

    /// Solves for the interior with Γ given.
    /// @param solution #unknowns by 3. In: what condense left, and Vᵏ⁺¹ - Vᵏ on Γ, whose rows are the last. Out:
    ///        Vᵏ⁺¹ - Vᵏ.
    /// @throws ComputationError if the result is not finite.
    void fill_in(Points& solution) const;

    /// The own vertices that may move, in the order of the solution's rows.
    [[nodiscard]] const std::vector<Index>& unknowns() const { return vertex_of_; }

    /// What the factor takes, in bytes, its copy in single precision on Γ aside.
    [[nodiscard]] std::size_t factor_bytes() const { return solver_->factor_bytes(); }

    /// What stays when its memory is given back, in bytes, that copy aside.
    [[nodiscard]] std::size_t bytes_on_interface() const { return row_of_last(n_interface()) * sizeof(double); }

  private:
    /// Where a row of the packed lower triangle `last_` begins.
    static std::size_t row_of_last(Index i) { return at(i) * (at(i) + 1) / 2; }
    [[nodiscard]] const double* last_row(Index i) const;
    SparsePattern number_unknowns();
    [[nodiscard]] Index n_entries() const { return column_offsets_.back(); }

    const SubMesh* sub_mesh_;
    std::unique_ptr<SymmetricLaplacian> laplacian_;
    /// In the order of elimination, Γ last and in its own order.
    std::vector<Index> vertex_of_;
    /// Of the pattern of the upper triangle, whose rows the solver has.
    std::vector<Index> column_offsets_;
    std::unique_ptr<LdlSolver> solver_;
    /// Per pair of the Laplacian: an entry of the pattern, or one behind them that nobody reads.
    std::vector<Index> slots_;
    KeptMemory memory_;
    bool borrows_memory_ = false;
    /// Of a factor that has been given back, the block on Γ: L below the diagonal and D on it, row by row.
    std::vector<double> last_;
    DenseFactor schur_;
};

}  // namespace seamflow
