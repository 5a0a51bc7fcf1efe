#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/ldl_panel.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// A dense L D Lᵀ row by row: D on the diagonal, L below it, nothing of use above it.
using DenseLdl = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// LDLᵀ factorisation of symmetric sparse matrices of one pattern, in the order in which the unknowns are. All but the
/// numbers is known beforehand. Different threads may factorise and solve at the same time, each with a workspace of
/// its own.
class LdlSolver {
  public:
    class Factor;

    /// Analyses the pattern, which is needed only during the call.
    /// @param upper the entries on and above the diagonal, the whole diagonal among them.
    /// @param n_last number of unknowns that are kept together at the end.
    /// @param tree where it is known already, if no unknowns are kept together; otherwise empty.
    /// @throws ComputationError if the factor would have 2³¹ entries or more.
    explicit LdlSolver(const SparsePattern& upper, Index n_last = 0, const EliminationTree& tree = {});

    [[nodiscard]] Index n() const { return pattern_.n(); }

    /// What a factor takes, in bytes.
    [[nodiscard]] std::size_t factor_bytes() const { return at(panels_.back()) * sizeof(double); }

    /// @param values one per entry of the pattern; needed only during the call.
    /// @param memory must outlive the factor, as must the solver.
    /// @returns nothing where the matrix is not positive definite.
    [[nodiscard]] std::optional<Factor> factorise(std::span<const double> values, FactorMemory& memory,
                                                  LdlWorkspace& workspace) const;

  private:
    /// What an earlier supernode takes away from columns of a later one.
    struct Update {
        Index earlier;
        /// The first of the earlier supernode's rows that belong to these columns, and how many do.
        Index place;
        Index n_columns;
    };

    void list_updates(const std::vector<Index>& supernode_of);
    void find_places(const SparsePattern& upper, const std::vector<Index>& supernode_of);
    void subtract_updates(Index supernode, double* factor, LdlWorkspace& workspace) const;
    [[nodiscard]] LdlPanel panel(double* factor, Index supernode) const
    {
        return {factor + panels_[supernode], pattern_.width(supernode), pattern_.rows[supernode]};
    }

    Index n_last_;
    /// Per entry of the matrix: where it stands in the factor.
    std::vector<Index> places_;
    SymbolicFactor pattern_;
    /// Per supernode, where it begins in the factor, and where the last one ends.
    std::vector<Index> panels_{0};
    /// Per supernode, and one more.
    std::vector<Index> update_offsets_;
    std::vector<Update> updates_;
};

/// L D Lᵀ of one matrix.
class LdlSolver::Factor {
  public:
    /// Solves for three right-hand sides.
    /// @param solution n by 3; may be the right-hand side.
    void solve(const Columns& right_hand_side, Columns& solution, LdlWorkspace& workspace) const;

    /// Forward substitution for all unknowns but the last: x becomes L⁻¹ x above, and below what remains for the last
    /// unknowns.
    /// @param x n by 3.
    void forward_substitute(Points& x) const { forward_substitute(x.data(), solver_->n() - solver_->n_last_); }

    /// Solves for all unknowns but the last.
    /// @param x n by 3. In: what `forward_substitute` left, and the last unknowns; out: the solution.
    void back_substitute(Points& x) const { back_substitute(x.data(), solver_->n() - solver_->n_last_); }

    /// What remains of the matrix for the last unknowns when all others are eliminated (Schur complement), factorised:
    /// a view of this factor.
    [[nodiscard]] DenseLdl last() const;

  private:
    friend class LdlSolver;
    Factor(const LdlSolver& solver, FactorNumbers<double> numbers)
        : solver_(&solver)
        , numbers_(std::move(numbers))
    {
    }

    void forward_substitute(double* x, Index n) const;
    void back_substitute(double* x, Index n) const;

    const LdlSolver* solver_;
    FactorNumbers<double> numbers_;
};

}  // namespace seamflow
