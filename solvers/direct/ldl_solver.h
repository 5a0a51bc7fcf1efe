#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/elimination_schedule.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/ldl_panel.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// The largest power of two not above a positive number: division by it is exact. 1 for numbers that are not positive,
/// not finite, or so small that this power has no inverse.
inline double power_of_two_near(double number)
{
    return number > 0x1p-1000 && std::isfinite(number) ? std::ldexp(1.0, std::ilogb(number)) : 1.0;
}

/// A dense L D Lᵀ row by row: D on the diagonal, L below it, unused entries above.
template <class Number>
using DenseLdl = Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

template <class Number>
class LdlFactor;

/// The expected signs of the pivots of a matrix: positive, for a positive definite one; or those of its diagonal, for a
/// quasi-definite one (Vanderbei, Symmetric Quasidefinite Matrices, 1995).
enum class Pivots { Positive, LikeDiagonal };

/// LDLᵀ factorisation of symmetric sparse matrices of one pattern, in the given order of the unknowns. Everything
/// except the numbers is known in advance. Different threads may factorise at the same time, each with a workspace of
/// its own; or several threads factorise one matrix, and the result does not depend on their number.
class LdlSolver {
  public:
    /// Analyses the pattern, which is needed only during the call.
    /// @param upper the entries on and above the diagonal, the whole diagonal among them.
    /// @param n_last the number of unknowns that are kept together at the end; factors then have rows().
    /// @param tree if already known and no unknowns are kept together; otherwise empty.
    /// @param exec runs loops on several threads; empty: everything runs on the calling thread.
    /// @param pivots the expected signs; other signs end a factorisation.
    /// @pre no unknowns are kept together if there is an `exec`.
    /// @throws ComputationError if the factor would have 2³¹ entries or more.
    explicit LdlSolver(const SparsePattern& upper, std::optional<Index> n_last = {}, const EliminationTree& tree = {},
                       Executor exec = {}, Pivots pivots = Pivots::Positive);

    [[nodiscard]] Index n() const { return pattern_.n(); }

    /// Size of a factor, in bytes.
    template <class Number>
    [[nodiscard]] std::size_t factor_bytes() const
    {
        return n_numbers() * sizeof(Number);
    }

    /// Factorises in single or double precision.
    /// @param values one per entry of the pattern; needed only during the call.
    /// @param memory must outlive the factor, as must the solver.
    /// @param least_pivot relative to the diagonal entry of the matrix: a smaller pivot has lost too many digits.
    /// @returns nothing if a pivot is too small, or not of the expected sign.
    template <class Number>
    [[nodiscard]] std::optional<LdlFactor<Number>> factorise(std::span<const double> values, FactorMemory& memory,
                                                             LdlWorkspace& workspace, Number least_pivot = {}) const;

    /// The Schur complement of the most recently factorised matrix on the last unknowns, also factorised, in units of
    /// the factor's scale. It is in the workspace, and valid until that is used again.
    template <class Number>
    [[nodiscard]] DenseLdl<Number> last(const LdlWorkspace& workspace) const
    {
        return {std::get<std::vector<Number>>(workspace.last).data(), n_last_, n_last_};
    }

  private:
    template <class Number>
    friend class LdlFactor;

    /// An update of columns of a later supernode by an earlier one.
    struct Update {
        /// The supernode at the other end: the earlier or the later one, depending on the list.
        Index supernode;
        /// The index of the first of the earlier supernode's rows that belong to these columns; and the number of the
        /// columns.
        Index row_index;
        Index n_columns;
    };

    /// The number of entries of a factor before the block of the unknowns that are kept together.
    [[nodiscard]] Index n_factor_numbers() const { return n_last_ > 0 ? panels_.rbegin()[1] : panels_.back(); }
    /// The number of floating-point numbers of a factor: its entries without that block, and three right-hand sides if
    /// it has rows().
    [[nodiscard]] std::size_t n_numbers() const
    {
        return usize(n_factor_numbers()) + (has_rows_ ? usize(ldl_row) * usize(n()) : 0);
    }
    void list_updates(const std::vector<Index>& supernode_of);
    void list_targets();
    void find_slots(const SparsePattern& upper, const std::vector<Index>& supernode_of);
    void enlarge(LdlWorkspace& workspace) const;
    template <class Number>
    [[nodiscard]] bool factorise_supernode(Index supernode, const LdlPanel<Number>& panel, Number* factor,
                                           LdlWorkspace& workspace, Number least_pivot) const;
    template <class Number>
    [[nodiscard]] bool factorise_by_subtrees(Number* factor, Number least_pivot) const;
    template <class Number>
    void subtract_from_targets(Index above, Number* factor) const;
    template <class Number>
    void subtract_updates(const LdlPanel<Number>& later, Index supernode, Number* factor,
                          LdlWorkspace& workspace) const;
    template <class Number>
    [[nodiscard]] LdlPanel<Number> panel(Number* factor, Index supernode) const
    {
        return {factor + panels_[supernode], pattern_.width(supernode), pattern_.rows[supernode]};
    }

    /// The number of unknowns that are kept together at the end; and whether factors have rows().
    Index n_last_;
    bool has_rows_;
    /// Per entry of the matrix: its index in the factor.
    std::vector<Index> slots_;
    SymbolicFactor pattern_;
    /// Per supernode, the index of its first number in the factor; then the end of the last supernode.
    std::vector<Index> panels_{0};
    /// Per supernode, the updates by earlier supernodes; if there is a schedule, only by supernodes in groups.
    Lists<Update> updates_;
    Executor exec_;
    Pivots pivots_;
    EliminationSchedule schedule_;
    /// Per supernode above the groups, its updates of later supernodes, which are all above the groups.
    Lists<Update> targets_;
};

/// L D Lᵀ of one matrix, in units of scale(), without the block of the last unknowns.
/// @tparam Number float or double.
template <class Number>
class LdlFactor {
  public:
    /// The scale: a power of two, so that a matrix of any unit fits in single precision; 1 in double precision.
    [[nodiscard]] double scale() const { return scale_; }

    /// Solves for three right-hand sides.
    /// @pre no unknowns are kept together at the end.
    /// @param solution n by 3; may be the right-hand side.
    void solve(const Columns& right_hand_side, Columns& solution, LdlWorkspace& workspace) const;

    /// Solves for many right-hand sides, in the thread of the caller. Each result is that of `solve`.
    /// @pre no unknowns are kept together at the end.
    /// @param x n by wide_ldl_row, row by row: right-hand sides, replaced by solutions.
    void solve_wide(Number* x) const requires std::is_same_v<Number, double>;

    /// The factor's own memory for three right-hand sides or their solutions: n by ldl_row, row by row.
    /// @pre the solver was constructed with n_last.
    [[nodiscard]] Number* rows() { return numbers_.get() + solver_->n_factor_numbers(); }

    /// Forward substitution for all unknowns except the last: their rows become L⁻¹ rows(), and the last rows become
    /// the right-hand sides for the last unknowns.
    void forward_substitute();

    /// Solves for all unknowns except the last, after `forward_substitute`.
    /// @pre The caller has replaced the last rows of rows() by the solution there, in units of 1 / scale(). Afterwards
    ///      all rows hold the solution, in the same unit.
    void back_substitute();

  private:
    friend class LdlSolver;
    LdlFactor(const LdlSolver& solver, FactorNumbers<Number> numbers, double scale)
        : solver_(&solver)
        , numbers_(std::move(numbers))
        , scale_(scale)
    {
    }

    /// Substitution for the supernodes of the first n unknowns.
    /// @param x all unknowns by Length, row by row.
    template <Index Length>
    void forward_substitute(Number* x, Index n) const;
    template <Index Length>
    void back_substitute(Number* x, Index n) const;
    template <Index Length>
    void back_substitute_supernode(Number* x, Index supernode) const;

    const LdlSolver* solver_;
    FactorNumbers<Number> numbers_;
    double scale_;
};

}  // namespace seamflow
