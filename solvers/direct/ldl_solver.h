#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "solvers/direct/columns.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/ldl_panel.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/factor_pattern.h"

namespace seamflow {

/// A dense L D Lᵀ row by row: D on the diagonal, L below it, nothing of use above it.
using DenseLdl = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// LDLᵀ factorisation of symmetric sparse matrices of one pattern, in the order in which the unknowns are. All but the
/// numbers is known beforehand. Different objects may be used by different threads at the same time, each with a
/// workspace of its own.
class LdlSolver {
  public:
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
    /// @param memory must outlive the factor.
    /// @returns whether the matrix is positive definite. If not, there is no factor.
    [[nodiscard]] bool factorise(std::span<const double> values, FactorMemory& memory, LdlWorkspace& workspace);

    [[nodiscard]] bool has_factor() const { return !memory_.empty(); }

    /// Solves for three right-hand sides.
    /// @pre there is a factor.
    /// @param solution n by 3; may be the right-hand side.
    void solve(const Columns& right_hand_side, Columns& solution, LdlWorkspace& workspace) const;

    /// Eliminates all unknowns but the last: x becomes L⁻¹ x above, and below what remains for the last unknowns.
    /// @pre there is a factor.
    /// @param x n by 3.
    void eliminate(Points& x) const { eliminate(x.data(), n() - n_last_); }

    /// Solves for all unknowns but the last.
    /// @pre there is a factor.
    /// @param x n by 3. In: what `eliminate` left, and the last unknowns; out: the solution.
    void substitute_back(Points& x) const { substitute_back(x.data(), n() - n_last_); }

    /// What remains of the matrix for the last unknowns when all others are eliminated (Schur complement), factorised.
    /// @pre there is a factor, in whose memory it stands.
    [[nodiscard]] DenseLdl last() const;

    /// Gives the factor's memory back to where it was taken from.
    void free_factor(FactorMemory& memory);

  private:
    /// What an earlier block takes away from columns of a later one.
    struct Update {
        Index earlier;
        /// The first of the earlier block's rows that belong to these columns, and how many do.
        Index place;
        Index n_columns;
    };

    void list_updates(const std::vector<Index>& block_of);
    void find_places(const SparsePattern& upper, const std::vector<Index>& block_of);
    void subtract_updates(Index block, LdlWorkspace& workspace) const;
    void eliminate(double* x, Index n) const;
    void substitute_back(double* x, Index n) const;
    [[nodiscard]] double* values() const { return reinterpret_cast<double*>(memory_.data()); }
    [[nodiscard]] LdlPanel panel(Index block) const
    {
        return {values() + panels_[block], pattern_.width(block), pattern_.rows[block]};
    }

    Index n_last_;
    /// Per entry of the matrix: where it stands in the factor's memory.
    std::vector<Index> places_;
    FactorPattern pattern_;
    /// Per block, where it begins in the factor's memory, and where the last one ends.
    std::vector<Index> panels_{0};
    /// Per block, and one more.
    std::vector<Index> update_offsets_;
    std::vector<Update> updates_;
    std::span<std::byte> memory_;
};

}  // namespace seamflow
