#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/direct/direct_solver.h"
#include "solvers/systems/sub_mesh_system.h"
#include "solvers/systems/symmetric_matrix.h"

namespace seamflow {

/// The rows of a sub-mesh on Γ, the vertices that it shares with other sub-meshes. At each of them the sub-mesh either
/// leads, which means that its equations determine the vertex, or follows: then the position after the step is known
/// from another sub-mesh, which has solved before (see InterfaceRole).
enum class SymmetricRows {
    /// No rows: the sub-mesh follows everywhere.
    Dirichlet,
    /// Where the sub-mesh leads, the row of the undecomposed step, which reaches vertices beyond Γ. Their positions are
    /// predicted for Γ at rest. If the vertex v of the row moves, a vertex w beyond Γ is assumed to follow by a
    /// fraction ρ_w of its movement, the response of the other side: V_w = Ŵ_w + ρ_w (V_v - Vᵏ_v), Ŵ being the
    /// prediction (see predicted_side.h).
    Transmission,
};

/// The equations of a sub-mesh, (M + dt K) V = M Vᵏ in all rows, including those on Γ, with the symmetric matrices of a
/// SymmetricLaplacian over the faces on both sides of Γ. Factorised as L D Lᵀ or by CHOLMOD. Known values go to the
/// right-hand side: fixed vertices, Γ where the sub-mesh follows, the predicted other side.
class SymmetricSystem final : public SubMeshSystem {
  public:
    /// @param parts with a symmetric Laplacian; with SymmetricRows::Transmission, one whose rows respond at all
    /// vertices of Γ (see responds_at). The factorisation is not Umfpack.
    SymmetricSystem(const SystemParts& parts, SymmetricRows rows, SolverWorkspace& workspace);

    Assembled assemble(const Points& positions, const Points& other_side, double time_step, double p,
                       std::span<const InterfaceRole> roles, SolverWorkspace& workspace) override;
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_->factor_bytes(); }
    [[nodiscard]] bool uses_faces() const override { return matrix_.laplacian->uses_faces(); }
    [[nodiscard]] Factorisation factorisation() const override { return solver_->kind(); }
    Factor factorise(const Assembled& equations, FactorMemory& memory, SolverWorkspace& workspace) override;
    void use_data(const Points& data) override;
    void use_other_side(const Points& positions, const Points& other_side) override;
    /// @param solution in: known values on Γ; out: all values.
    void solve(const Factor& factor, const Points& positions, Points& solution, SolverWorkspace& workspace) override;

  private:
    /// A coefficient in the row of an unknown, at a known vertex.
    struct Coupling {
        Index unknown;
        Index vertex;
        double value;
    };
    /// One off-diagonal entry of the matrix in the row or column of a vertex of Γ.
    struct InterfaceEntry {
        Index slot;
        /// The other unknown.
        Index unknown;
        /// The coefficient, while it is moved out of the matrix: if the sub-mesh follows at the vertex in this step.
        double coefficient;
    };
    /// A vertex of Γ.
    struct InterfaceRow {
        Index unknown;
        /// The beginnings of the row's entries of the matrix and of its couplings in `beyond_`; they end where those of
        /// the next row begin.
        Index first_entry;
        Index first_beyond;
        InterfaceRole role = InterfaceRole::Follows;
        /// The sum of a_w ρ_w over the vertices w beyond Γ, a_w being the coefficient in dt K: by so much the responses
        /// of the other side change the diagonal. 0 if there are none.
        double response = 0.0;
        /// The contribution of the predicted positions beyond Γ to the right-hand side: minus the sum of a_w Ŵ_w.
        Point beyond = Point::Zero();
    };

    SparsePattern order_unknowns(const std::vector<VertexPair>& pairs, std::vector<Index>& unknown_of,
                                 EliminationTree& tree);
    void list_couplings(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of);
    void list_interface(const SparsePattern& upper, const std::vector<Index>& unknown_of);
    void make_dirichlet_row(std::size_t i, std::span<double> values);
    void make_transmission_row(std::size_t i, const Points& positions, double time_step, double diagonal,
                               std::span<double> values);
    void drop_responses(std::span<double> values);
    void fill_right_hand_side(const Points& positions, const Points& known, Columns& right) const;
    [[nodiscard]] Index vertex_at(std::size_t i) const { return sub_mesh_->interface.vertices[i]; }

    const SubMesh* sub_mesh_;
    /// The matrix. Its further values are the coefficients of `fixed_`, then those of `beyond_`.
    SymmetricMatrix matrix_;
    std::unique_ptr<DirectSolver> solver_;
    /// The coefficients at own vertices that are never unknown; the coefficients at vertices beyond Γ, which are those
    /// of the halo.
    std::vector<Coupling> fixed_;
    std::vector<Coupling> beyond_;
    /// #Γ + 1: the rows at the vertices of Γ, and the end of the last. Empty with SymmetricRows::Dirichlet.
    std::vector<InterfaceRow> rows_;
    std::vector<InterfaceEntry> entries_;
    /// Per unknown: M in the present step.
    std::vector<double> mass_;
    /// dt of the present step, in length².
    double time_step_ = 0.0;
    /// Whether the right-hand side has the attachment, which pulls each vertex to its place in V⁰.
    bool pulls_ = false;
};

}  // namespace seamflow
