#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/decomposition/sweep_plan.h"
#include "solvers/conditions/transmission_condition.h"
#include "solvers/laplacian/laplacian_assembler.h"
#include "solvers/umfpack_solver.h"

namespace seamflow {

/// The equations of one backward Euler step on one sub-mesh, A X = B with one row per own vertex:
///   fixed vertices       V^{k+1} = V^k
///   Γ, following         V^{k+1} = what the leading sub-mesh found
///   Γ, leading           the transmission condition
///   all others           (I + dt Δ) V^{k+1} = V^k, Δ from the sub-mesh's own faces
/// The pattern is made and analysed once and covers every role; each step refills the values in place.
class SubMeshSystem {
  public:
    /// @param sub_mesh must outlive the system.
    /// @param condition what stands on Γ where the sub-mesh leads.
    /// @throws ComputationError if the analysis fails.
    SubMeshSystem(const SubMesh& sub_mesh, Laplacian laplacian, std::unique_ptr<TransmissionCondition> condition);

    /// Fills A, and B as far as it follows from Vᵏ.
    /// @param positions #local by 3, the halo included: Vᵏ.
    /// @param other_side #local by 3: Vᵏ as the sub-meshes beyond Γ have it, on Γ and in the halo. The same as
    ///        `positions` but where every sub-mesh has a copy of Γ of its own.
    /// @param time_step dt, in length².
    /// @param p Robin parameter, in 1/length.
    /// @param roles one per vertex of Γ.
    void assemble(const Points& positions, const Points& other_side, double time_step, double p,
                  std::span<const InterfaceRole> roles);

    /// @throws ComputationError if A is singular or not finite.
    void factorise();

    /// Solves with Γ held at Vᵏ where the sub-mesh follows: what it would do if nobody around moved.
    /// @param positions #local by 3: Vᵏ.
    /// @param prediction #local by 3; receives the result at own vertices.
    /// @throws ComputationError if the result is not finite.
    void predict(const Points& positions, Points& prediction);

    /// Renews B where the sub-mesh leads.
    /// @param positions #local by 3: Vᵏ.
    /// @param other_side #local by 3: what is known of Vᵏ⁺¹ beyond Γ, on Γ and in the halo.
    void use_other_side(const Points& positions, const Points& other_side);

    /// Solves for Vᵏ⁺¹, then gives the factor's memory back.
    /// @param solution #local by 3. In: Vᵏ⁺¹ at those vertices of Γ where the sub-mesh follows. Out: Vᵏ⁺¹ at all own
    ///        vertices; where it follows, and at fixed vertices, to the bit what was given.
    /// @throws ComputationError if the result is not finite.
    void solve(Points& solution);

    /// Number of entries of A.
    [[nodiscard]] Index n_entries() const { return pattern_->n_entries(); }

  private:
    /// What stands in the row of a vertex.
    enum class Row : std::uint8_t { Laplacian, Fixed, Interface };

    void make_rows();
    void assemble_interface(const Points& positions, const Points& other_side);
    void solve_with(const Points& given, Points& solution);

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
    std::unique_ptr<UmfpackSolver> solver_;
};

}  // namespace seamflow
