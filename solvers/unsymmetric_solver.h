#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "solvers/lu_solver.h"
#include "solvers/solver_workspace.h"
#include "solvers/umfpack_solver.h"

namespace seamflow {

/// LU factorisation of any sparse matrices of one pattern, analysed once, factorised for each set of values: by an
/// LuSolver where the diagonal will do, by UMFPACK, which looks for better pivots, where it will not. UMFPACK also has
/// large matrices, for which its dense blocks make it faster. Which of the two it is depends on the matrix alone.
class UnsymmetricSolver {
  public:
    /// @param pattern must outlive the solver.
    /// @throws ComputationError if the analysis fails (memory).
    explicit UnsymmetricSolver(const SparsePattern& pattern);

    /// What a factor takes, in bytes; of UMFPACK's an estimate.
    [[nodiscard]] std::size_t factor_bytes() const;

    /// @param values one per entry of the pattern; must stay as they are until the solve.
    /// @throws ComputationError if the matrix is singular or memory runs out.
    void factorise(std::span<const double> values, SolverWorkspace& workspace);

    /// Whether the matrix that was factorised last leaves a solution three correct digits at most.
    [[nodiscard]] bool is_nearly_singular() const { return is_nearly_singular_; }

    /// Solves for three right-hand sides.
    /// @pre there is a factor: factorise has been called since the last free_factor.
    /// @param solution n by 3.
    /// @throws ComputationError if UMFPACK fails.
    void solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution,
               SolverWorkspace& workspace);

    /// Gives the factor's memory back to where it was taken from.
    void free_factor(FactorMemory& memory);

  private:
    const SparsePattern* pattern_;
    /// Nothing if the matrix is large.
    std::unique_ptr<LuSolver> lu_;
    /// Nothing until it is needed.
    std::unique_ptr<UmfpackSolver> umfpack_;
    bool is_nearly_singular_ = false;
};

}  // namespace seamflow
