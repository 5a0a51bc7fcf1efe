#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "solvers/cholmod_solver.h"
#include "solvers/ldl_solver.h"
#include "solvers/solver_workspace.h"

namespace seamflow {

/// Factorisation of symmetric positive definite sparse matrices of one pattern, in the order in which the unknowns are:
/// analysed once, factorised for each set of values. By an LdlSolver; large ones by CHOLMOD, whose dense blocks make it
/// faster there.
class SymmetricSolver {
  public:
    /// @param upper the entries on and above the diagonal, the whole diagonal among them.
    /// @param tree where it is known already; otherwise empty.
    /// @throws ComputationError if the analysis fails (memory).
    SymmetricSolver(SparsePattern upper, SolverWorkspace& workspace, const EliminationTree& tree = {});

    /// What a factor takes, in bytes. CHOLMOD's are in its own memory, of which this is most.
    [[nodiscard]] std::size_t factor_bytes() const;

    /// @param values one per entry of the pattern.
    /// @returns whether the matrix is positive definite. If not, there is no factor.
    /// @throws ComputationError if memory runs out.
    [[nodiscard]] bool factorise(std::span<const double> values, SolverWorkspace& workspace);

    /// Solves for three right-hand sides.
    /// @pre there is a factor.
    /// @param solution receives n by 3.
    /// @throws ComputationError if CHOLMOD fails.
    void solve(Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) const;

    /// Gives the factor's memory back to where it was taken from.
    void free_factor(FactorMemory& memory);

  private:
    /// CHOLMOD's: the other one has what it needs of it.
    SparsePattern upper_;
    /// One of the two.
    std::unique_ptr<LdlSolver> ldl_;
    std::unique_ptr<CholmodSolver> cholmod_;
};

}  // namespace seamflow
