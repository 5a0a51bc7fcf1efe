#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "partition/decomposition/overlap.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/direct_solver.h"
#include "solvers/laplacian/laplacian_assembler.h"

namespace seamflow {

/// Those equations (I + dt Δ) V^{k+1} = V^k of the whole mesh that stand at the vertices of a grown part, for any
/// Laplacian: solved by an LU factorisation with all other vertices given (one block of an overlapping Schwarz method).
/// The pattern is made and analysed once; each step refills the values in place.
class SchwarzBlock {
  public:
    /// Layers of faces beyond the equations that they depend on (see make_grown_part): Δ_P has the widest rows.
    static constexpr int reach = 2;

    /// @param part must outlive the block.
    /// @throws ComputationError if the analysis fails.
    SchwarzBlock(const GrownPart& part, Laplacian laplacian, Factorisation factorisation = Factorisation::Automatic);

    /// The vertices of the equations, and those others that may move and occur in them, local to the part; ascending.
    [[nodiscard]] const std::vector<Index>& unknowns() const { return part_->unknowns; }
    [[nodiscard]] const std::vector<Index>& beyond() const { return beyond_; }

    [[nodiscard]] const SubMesh& sub_mesh() const { return part_->sub_mesh; }

    /// What the factor takes, in bytes; of UMFPACK's an estimate.
    [[nodiscard]] std::size_t factor_bytes() const { return solver_ ? solver_->factor_bytes() : 0; }

    /// Whose the factorisation is (see DirectSolver::kind); nothing without unknowns.
    [[nodiscard]] std::optional<Factorisation> factorisation() const
    {
        return solver_ ? std::optional(solver_->kind()) : std::nullopt;
    }

    /// Fills in all that follows from Vᵏ, and factorises.
    /// @param positions #local by 3: Vᵏ.
    /// @throws ComputationError if the equations are singular or not finite.
    void assemble(const Points& positions, double time_step);
    void factorise(SolverWorkspace& workspace);

    /// How many factorisations so far were of equations that are nearly singular: three correct digits at most.
    [[nodiscard]] Index n_nearly_singular() const { return n_nearly_singular_; }

    /// Which right-hand side stands beside what the vertices beyond contribute.
    enum class RightHandSide {
        /// That of the step.
        Step,
        /// None: the answer to what is beyond alone, which is linear in it.
        Zero,
    };

    /// Solves with the vertices beyond given.
    /// @param given #beyond by 3.
    /// @param solution receives #unknowns by 3.
    /// @throws ComputationError if the result is not finite.
    void solve(const Points& given, RightHandSide right_hand_side, Columns& solution, SolverWorkspace& workspace);

  private:
    /// Where a coefficient of an equation stands whose column is none of the unknowns.
    struct Coupling {
        Index unknown = 0;
        /// Local; in `beyond_couplings_` its place in `beyond_`.
        Index vertex = 0;
        friend auto operator<=>(const Coupling&, const Coupling&) = default;
    };

    void list_couplings(const std::vector<MatrixEntry>& entries);
    void make_slots(const std::vector<MatrixEntry>& entries);

    const GrownPart* part_;
    std::unique_ptr<LaplacianAssembler> laplacian_;
    /// Per local vertex, its place among the unknowns, or -1.
    std::vector<Index> unknown_of_;
    std::vector<Index> beyond_;
    std::unique_ptr<SparsePattern> pattern_;
    std::vector<Coupling> beyond_couplings_;
    std::vector<Coupling> fixed_couplings_;
    /// Per entry of the Laplacian: an entry of the pattern, then of `beyond_couplings_`, then of `fixed_couplings_`,
    /// then one that nobody reads.
    std::vector<Index> slots_;
    std::vector<Index> diagonal_slots_;
    std::vector<double> values_;
    /// #unknowns by 3, what fixed vertices contribute included.
    Columns right_hand_side_;
    /// Nothing without unknowns.
    std::unique_ptr<DirectSolver> solver_;
    Index n_nearly_singular_ = 0;
};

}  // namespace seamflow
