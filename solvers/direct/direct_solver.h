#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "solvers/direct/factorisation.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/factor_pattern.h"

namespace seamflow {

/// Factorisation of sparse matrices of one pattern: analysed once, factorised for each set of values, a factor used for
/// any number of right-hand sides, three at a time. Different objects may be used by different threads at the same
/// time, each with a workspace of its own.
class DirectSolver {
  public:
    virtual ~DirectSolver() = default;

    /// Whose it is, of the factor that there is or of the next one; never Automatic.
    [[nodiscard]] virtual Factorisation kind() const = 0;

    /// What a factor takes, in bytes; of UMFPACK's an estimate. CHOLMOD's and UMFPACK's are in their own memory.
    [[nodiscard]] virtual std::size_t factor_bytes() const = 0;

    /// @param values one per entry of the pattern; must stay as they are until the last solve.
    /// @returns whether there is a factor: of symmetric matrices those that are positive definite have one.
    /// @throws ComputationError if a matrix that need not be symmetric is singular, or memory runs out.
    [[nodiscard]] virtual bool factorise(std::span<const double> values, SolverWorkspace& workspace) = 0;

    /// Whether the matrix that was factorised last leaves a solution three correct digits at most.
    [[nodiscard]] virtual bool is_nearly_singular() const { return false; }

    /// Solves for three right-hand sides.
    /// @pre there is a factor.
    /// @param solution receives n by 3.
    /// @throws ComputationError if CHOLMOD or UMFPACK fails.
    virtual void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) = 0;

    /// Gives the factor's memory back to where it was taken from.
    virtual void free_factor(FactorMemory& memory) = 0;
};

/// For symmetric positive definite matrices, in the order in which the unknowns are.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @param factorisation not Umfpack.
/// @param tree where it is known already; otherwise empty.
/// @throws ComputationError if the analysis fails (memory).
std::unique_ptr<DirectSolver> make_symmetric_solver(SparsePattern upper, Factorisation factorisation,
                                                    SolverWorkspace& workspace, const EliminationTree& tree = {});

/// For any matrices.
/// @param pattern must outlive the solver.
/// @throws ComputationError if the analysis fails (memory).
std::unique_ptr<DirectSolver> make_general_solver(const SparsePattern& pattern, Factorisation factorisation);

}  // namespace seamflow
