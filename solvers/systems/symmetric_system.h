#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/direct/direct_solver.h"
#include "solvers/laplacian/symmetric_laplacian.h"
#include "solvers/systems/sub_mesh_system.h"
#include "solvers/systems/upper_pattern.h"

namespace seamflow {

/// What stands on Γ where a sub-mesh leads.
enum class SymmetricRows {
    /// Nothing: it follows everywhere.
    None,
    /// The undecomposed step's row, the other side predicted and yielding (see predicted_side.h).
    Yielding,
};

/// The equations of a sub-mesh where all of them, the rows on Γ included, are (M + dt K) V = M Vᵏ with the symmetric
/// matrices of a SymmetricLaplacian over the faces on both sides of Γ, by a Cholesky factorisation. What is known goes
/// to the right-hand side: fixed vertices, Γ where the sub-mesh follows, the other side as predicted.
class SymmetricSystem final : public SubMeshSystem {
  public:
    /// @param sub_mesh must outlive the system.
    /// @param laplacian one that is symmetric; with SymmetricRows::Yielding, Alexa-Wardetzky where all faces that touch
    ///        Γ are triangles.
    /// @param factorisation not Umfpack.
    SymmetricSystem(const SubMesh& sub_mesh, Laplacian laplacian, SymmetricRows rows, Factorisation factorisation,
                    SolverWorkspace& workspace);

    void assemble(const Points& positions, const Points& other_side, double time_step, double p,
                  std::span<const InterfaceRole> roles, SolverWorkspace& workspace) override;
    [[nodiscard]] FacesInUse faces_in_use() const override
    {
        return laplacian_->uses_faces() ? FacesInUse::Corners : FacesInUse::None;
    }
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_->factor_bytes(); }
    [[nodiscard]] Factorisation factorisation() const override { return solver_->kind(); }
    void factorise(SolverWorkspace& workspace) override;
    void predict(const Points& positions, Points& prediction, SolverWorkspace& workspace) override;
    void use_other_side(const Points& positions, const Points& other_side) override;
    void solve(const Points& positions, Points& solution, SolverWorkspace& workspace) override;

  private:
    /// One entry of the matrix off the diagonal, seen from a vertex of Γ.
    struct InterfaceEntry {
        Index slot;
        /// The other unknown.
        Index unknown;
    };
    /// The state of one vertex of Γ in a step.
    struct InterfaceRow {
        InterfaceRole role = InterfaceRole::Follows;
        /// What the other side changes on the diagonal by yielding; 0 where it does not.
        double yield = 0.0;
        /// What the vertices beyond Γ add to the right-hand side.
        Point beyond = Point::Zero();
    };

    void number_unknowns(SymmetricRows rows, std::vector<Index>& unknown_of);
    SparsePattern list_entries(const std::vector<VertexPair>& pairs, std::vector<Index>& unknown_of,
                               EliminationTree& tree);
    void list_couplings(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of);
    void list_interface(const SparsePattern& upper, const std::vector<Index>& unknown_of);
    void hold(std::size_t i, std::span<double> values);
    void yield(std::size_t i, const Points& positions, double time_step, double diagonal, std::span<double> values);
    void stop_yielding(std::span<double> values);
    void fill_right_hand_side(const Points& positions, const Points& known, Columns& right) const;
    void solve_with(const Points& positions, Points& solution, SolverWorkspace& workspace);
    [[nodiscard]] Index n_entries() const { return column_offsets_.back(); }

    const SubMesh* sub_mesh_;
    std::unique_ptr<SymmetricLaplacian> laplacian_;
    /// In the order of elimination.
    std::vector<Index> vertex_of_;
    /// Of the pattern of the upper triangle, whose rows the solver has.
    std::vector<Index> column_offsets_;
    std::unique_ptr<DirectSolver> solver_;
    /// Per pair of the Laplacian: an entry of the pattern, then of `fixed_`, then of `beyond_`, then one that nobody
    /// reads.
    std::vector<Index> slots_;
    /// Coefficients at own vertices that are never unknown; and at vertices of the halo.
    std::vector<Coupling> fixed_;
    std::vector<Coupling> beyond_;
    /// Per vertex of Γ: its unknown, its entries of the matrix, and its part of `beyond_`, which has one more offset.
    std::vector<Index> interface_unknowns_;
    std::vector<InterfaceEntry> interface_entries_;
    std::vector<Index> interface_offsets_;
    std::vector<Index> beyond_offsets_;
    std::vector<InterfaceRow> interface_rows_;
    /// Coefficients at vertices of Γ where the sub-mesh follows in this step.
    std::vector<Coupling> held_;
    /// Per unknown.
    std::vector<double> mass_;
};

}  // namespace seamflow
