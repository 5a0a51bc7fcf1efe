#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solvers/direct/direct_solver.h"
#include "solvers/laplacian/laplacian_assembler.h"
#include "solvers/systems/sub_mesh_system.h"

namespace seamflow {

/// The equations of a sub-mesh as they stand, A X = B with one row per own vertex, any Laplacian and any condition on
/// Γ, by an LU factorisation. The pattern is made and analysed once and covers every role; each step refills the values
/// in place.
class GeneralSystem final : public SubMeshSystem {
  public:
    /// @param sub_mesh must outlive the system.
    /// @param condition what stands on Γ where the sub-mesh leads.
    /// @throws ComputationError if the analysis fails.
    GeneralSystem(const SubMesh& sub_mesh, Laplacian laplacian, std::unique_ptr<TransmissionCondition> condition,
                  Factorisation factorisation);

    void assemble(const Points& positions, const Points& other_side, double time_step, double p,
                  std::span<const InterfaceRole> roles, SolverWorkspace& workspace) override;
    [[nodiscard]] std::size_t factor_bytes() const override { return solver_->factor_bytes(); }
    [[nodiscard]] Factorisation factorisation() const override { return solver_->kind(); }
    void factorise(SolverWorkspace& workspace) override;
    [[nodiscard]] Index n_nearly_singular() const override { return n_nearly_singular_; }
    void predict(const Points& positions, Points& prediction, SolverWorkspace& workspace) override;
    void use_other_side(const Points& positions, const Points& other_side) override;
    void solve(const Points& positions, Points& solution, SolverWorkspace& workspace) override;

  private:
    /// What stands in the row of a vertex.
    enum class Row : std::uint8_t { Laplacian, Fixed, Interface };

    void make_rows();
    void assemble_interface(const Points& positions, const Points& other_side);
    void solve_with(const Points& given, Points& solution, SolverWorkspace& workspace);

    const SubMesh* sub_mesh_;
    std::vector<Row> row_of_;
    std::unique_ptr<TransmissionCondition> condition_;
    std::unique_ptr<LaplacianAssembler> laplacian_;
    std::unique_ptr<SparsePattern> pattern_;
    /// Where the Laplacian's contributions go; one past the last value for rows that are none of its.
    std::vector<Index> laplacian_slots_;
    /// Per vertex, its place on the diagonal.
    std::vector<Index> diagonal_slots_;
    /// Per entry of the condition's columns.
    std::vector<Index> interface_slots_;
    /// One per entry of the pattern, and one that nobody reads.
    std::vector<double> values_;
    std::vector<InterfaceRole> roles_;
    std::vector<double> row_;
    Columns right_hand_side_;
    Columns solution_;
    std::unique_ptr<DirectSolver> solver_;
    Index n_nearly_singular_ = 0;
};

}  // namespace seamflow
