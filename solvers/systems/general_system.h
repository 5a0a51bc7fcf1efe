#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/laplacian/laplacian_assembler.h"
#include "solvers/systems/screening.h"
#include "solvers/systems/sub_mesh_system.h"

namespace seamflow {

/// The equations of a sub-mesh, A X = B with one row per own vertex, for any Laplacian and any condition on Γ, by an LU
/// factorisation. The pattern covers every role and is analysed once; each step refills the values in place.
class GeneralSystem final : public SubMeshSystem {
  public:
    /// @param condition the rows on Γ where the sub-mesh leads.
    /// @throws ComputationError if the analysis fails.
    GeneralSystem(SystemParts parts, std::unique_ptr<TransmissionCondition> condition);

    Assembled assemble(const Points& positions, const Points& other_side, double time_step, double p,
                       std::span<const InterfaceRole> roles, SolverWorkspace& workspace) override;
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_->factor_bytes(); }
    [[nodiscard]] Factorisation factorisation() const override { return solver_->kind(); }
    Factor factorise(const Assembled& equations, FactorMemory& memory, SolverWorkspace& workspace) override;
    [[nodiscard]] Index n_nearly_singular() const override { return n_nearly_singular_; }
    void use_data(const Points& data) override;
    void use_other_side(const Points& positions, const Points& other_side) override;
    void solve(const Factor& factor, const Points& positions, Points& solution, SolverWorkspace& workspace) override;

  private:
    /// The kind of a vertex's row.
    enum class Row : std::uint8_t { Laplacian, Fixed, Interface };

    void make_rows();
    [[nodiscard]] double& diagonal(Index v) { return values_[diagonal_slots_[v]]; }
    void assemble_interface(const Points& positions, const Points& other_side);
    [[nodiscard]] Point pull(Index v) const;

    const SubMesh* sub_mesh_;
    /// Per half-edge of an own face, its twin (see SubMesh::twin).
    std::vector<Index> twin_;
    std::vector<Row> row_of_;
    std::unique_ptr<TransmissionCondition> condition_;
    std::unique_ptr<LaplacianAssembler> laplacian_;
    SparsePattern pattern_;
    /// The indices in values_ of the entries of the Laplacian, where unwanted entries have the index of the last value,
    /// which is never read; of the diagonal entry of each vertex; and of the entries of the condition's columns.
    std::vector<Index> slots_;
    std::vector<Index> diagonal_slots_;
    std::vector<Index> interface_slots_;
    /// One value per entry of the pattern, and a last value that is never read.
    std::vector<double> values_;
    std::unique_ptr<DirectSolver> solver_;
    Index n_nearly_singular_ = 0;
    std::vector<InterfaceRole> roles_;
    /// Scratch: the coefficients of one row of the condition.
    std::vector<double> row_;
    Screening screening_;
    /// dt of the present step, in length².
    double time_step_ = 0.0;
    /// Whether the attachment to V⁰ is on the right-hand side.
    bool pulls_ = false;
    Columns right_hand_side_;
    Columns solution_;
};

}  // namespace seamflow
