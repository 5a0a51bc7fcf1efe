#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/direct/direct_solver.h"
#include "solvers/systems/sub_mesh_system.h"
#include "solvers/systems/symmetric_matrix.h"

namespace seamflow {

/// The rows on Γ where a sub-mesh leads.
enum class SymmetricRows {
    /// Nothing: it follows everywhere.
    Dirichlet,
    /// The undecomposed step's row, the other side predicted and responding (see predicted_side.h).
    Transmission,
};

/// The equations of a sub-mesh where all of them, the rows on Γ included, are (M + dt K) V = M Vᵏ with the symmetric
/// matrices of a SymmetricLaplacian over the faces on both sides of Γ, by L D Lᵀ or CHOLMOD. Known values go to the
/// right-hand side: fixed vertices, Γ where the sub-mesh follows, the other side as predicted.
class SymmetricSystem final : public SubMeshSystem {
  public:
    /// @param parts with a Laplacian that is symmetric; with SymmetricRows::Transmission, Alexa-Wardetzky where all
    ///        faces that touch Γ are triangles. The factorisation is not Umfpack.
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
    /// A coefficient of an unknown's row at a vertex that is known.
    struct Coupling {
        Index unknown;
        Index vertex;
        double value;
    };
    /// One entry of the matrix off the diagonal, seen from a vertex of Γ.
    struct InterfaceEntry {
        Index slot;
        /// The other unknown.
        Index unknown;
        /// The coefficient, if the sub-mesh follows at the vertex in this step.
        double held;
    };
    /// A vertex of Γ.
    struct InterfaceRow {
        Index unknown;
        /// Starts of its entries of the matrix and of its part of `beyond_`; they end where the next row's start.
        Index first_entry;
        Index first_beyond;
        InterfaceRole role = InterfaceRole::Follows;
        /// The response of the other side, added to the diagonal; 0 if there is none.
        double response = 0.0;
        /// Right-hand side from the vertices beyond Γ.
        Point beyond = Point::Zero();
    };

    SparsePattern list_entries(const std::vector<VertexPair>& pairs, std::vector<Index>& unknown_of,
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
    /// Its further values are those of `fixed_`, then of `beyond_`.
    SymmetricMatrix matrix_;
    std::unique_ptr<DirectSolver> solver_;
    /// Coefficients at own vertices that are never unknown; and at vertices of the halo.
    std::vector<Coupling> fixed_;
    std::vector<Coupling> beyond_;
    /// Per vertex of Γ, and one more; with Dirichlet rows none.
    std::vector<InterfaceRow> rows_;
    std::vector<InterfaceEntry> entries_;
    /// Per unknown, of this step.
    std::vector<double> mass_;
    /// dt of this step.
    double time_step_ = 0.0;
    /// Whether the right-hand side attaches to V⁰.
    bool pulls_ = false;
};

}  // namespace seamflow
