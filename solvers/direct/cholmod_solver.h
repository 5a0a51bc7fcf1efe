#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "solvers/direct/columns.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// LLᵀ factorisation of symmetric sparse matrices of one pattern by dense blocks, by CHOLMOD, in the order in which the
/// unknowns are: analysed once, factorised for each set of values, a factor used for any number of right-hand sides,
/// three at a time.
class CholmodSolver {
  public:
    /// @param upper the entries on and above the diagonal, the whole diagonal among them; must outlive the solver.
    /// @throws ComputationError if CHOLMOD fails (memory).
    CholmodSolver(const SparsePattern& upper, CholmodWorkspace& workspace);
    ~CholmodSolver();
    CholmodSolver(CholmodSolver&&) noexcept;
    CholmodSolver& operator=(CholmodSolver&&) noexcept;

    /// What a factor takes in CHOLMOD's own memory, in bytes: most of what it needs.
    [[nodiscard]] std::size_t factor_bytes() const;

    /// @param values one per entry of the pattern.
    /// @returns whether the matrix is positive definite. If not, there is no factor.
    /// @throws ComputationError if CHOLMOD fails (memory).
    [[nodiscard]] bool factorise(std::span<const double> values, CholmodWorkspace& workspace);

    /// Solves for three right-hand sides.
    /// @pre there is a factor.
    /// @returns n by 3, in the workspace: valid until that is used again.
    /// @throws ComputationError if CHOLMOD fails.
    [[nodiscard]] Eigen::Map<const Columns> solve(const Columns& right_hand_side, CholmodWorkspace& workspace) const;

    void free_factor();

    /// For the file that calls CHOLMOD.
    class Factor;

  private:
    std::unique_ptr<Factor> factor_;
};

}  // namespace seamflow
