#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "partition/index_lists.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// LU factorisation of sparse matrices of one pattern with all pivots taken from the diagonal. Everything except the
/// numbers is thus known in advance, and a column of L and the row of U across the diagonal are computed together: a
/// factor costs hardly more than that of a symmetric matrix. For matrices that are symmetric except for a few rows, or
/// diagonally dominant; other matrices are detected. Different threads may factorise and solve at the same time, each
/// with a workspace of its own.
class LuSolver {
  public:
    class Factor;

    /// Analyses the pattern, which is needed only during the call.
    /// @throws ComputationError if there is too little memory for the elimination ordering, or the pattern has too many
    /// entries.
    explicit LuSolver(const SparsePattern& pattern);

    /// Size of a factor, in bytes.
    [[nodiscard]] std::size_t factor_bytes() const { return panels_.back() * sizeof(Eigen::Array2d); }

    /// Factorises a matrix.
    /// @param values one per entry of the pattern; needed only during the call.
    /// @param memory must outlive the factor, as must the solver.
    /// @returns nothing if the diagonal is unsuitable: with rows divided by their sizes, a pivot is less than a
    ///          thousandth of an entry below it (UMFPACK's bound for symmetric patterns), or almost zero, or an entry
    ///          of U has grown to a million times its row.
    [[nodiscard]] std::optional<Factor> factorise(std::span<const double> values, FactorMemory& memory,
                                                  LuWorkspace& workspace) const;

  private:
    /// The position of a value while its column of L and row of U are computed.
    struct Load {
        /// The index of the value in the matrix.
        Index slot;
        /// Twice the unknown for the column of L; one more for the row of U.
        Index position;
    };

    void list_loads(const SparsePattern& pattern);
    void measure_rows(std::span<const double> values, LuWorkspace& workspace) const;
    void load(Index unknown, std::span<const double> values, LuWorkspace& workspace) const;
    void eliminate(Index supernode, Index column, const Factor& factor, LuWorkspace& workspace) const;
    bool store(Index supernode, Index column, const Factor& factor, LuWorkspace& workspace) const;

    SymbolicFactor pattern_;
    /// Per unknown, its values to load.
    Lists<Load> loads_;
    /// Per supernode, the index of its first column; then the end of the last supernode.
    std::vector<std::size_t> panels_{0};
};

/// L U of one matrix, supernode after supernode, column after column: entries of L and of Uᵀ in pairs. On the diagonal
/// is the inverse of the pivot; above it are unused entries.
class LuSolver::Factor {
  public:
    /// Solves for three right-hand sides.
    /// @param solution n by 3.
    void solve(const Columns& right_hand_side, Columns& solution, LuWorkspace& workspace) const;

  private:
    friend class LuSolver;
    Factor(const LuSolver& solver, FactorNumbers<Eigen::Array2d> pairs)
        : solver_(&solver)
        , pairs_(std::move(pairs))
    {
    }

    /// One column of a supernode, with an entry for each of the supernode's rows.
    [[nodiscard]] Eigen::Array2d* column_of(Index supernode, Index column) const
    {
        return pairs_.get() + solver_->panels_[supernode] + usize(column) * solver_->pattern_.rows[supernode].size();
    }

    const LuSolver* solver_;
    FactorNumbers<Eigen::Array2d> pairs_;
};

}  // namespace seamflow
