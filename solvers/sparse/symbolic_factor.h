#pragma once

#include <limits>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/sparse/elimination_ordering.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// The entries of the factors L and U of a matrix that may be nonzero if every pivot is taken from the diagonal, with
/// the matrix's pattern made symmetric. Unknowns are numbered in the elimination ordering, and gathered into
/// supernodes: consecutive unknowns whose columns of L have the same rows, apart from the rows of these unknowns. The
/// rows of U have the transposed pattern of the columns of L.
struct SymbolicFactor {
    /// An update of one column of L, and of one row of U, by an earlier supernode.
    struct Update {
        Index supernode;
        /// The index of the column among the supernode's rows.
        Index row_index;
    };

    /// Per unknown of the matrix, its number in the elimination ordering; empty if the numbers are the same.
    std::vector<Index> position;
    /// Number of supernodes + 1: the first unknown of each.
    std::vector<Index> first{0};
    /// Per supernode: its unknowns, then all other unknowns in whose rows its columns have entries, ascending.
    IndexLists rows;
    /// Number of unknowns + 1: the index in `updates` of the first update of each unknown's column. The updates come
    /// from other supernodes.
    std::vector<Index> update_offsets;
    std::vector<Update> updates;

    [[nodiscard]] Index n() const { return first.back(); }
    [[nodiscard]] Index n_supernodes() const { return static_cast<Index>(first.size()) - 1; }
    [[nodiscard]] Index width(Index supernode) const { return first[supernode + 1] - first[supernode]; }
};

/// Analyses a matrix of any pattern, in an elimination ordering of its own.
/// @throws ComputationError if there is too little memory for the elimination ordering, or 2³¹ entries or more.
SymbolicFactor make_symbolic_factor(const SparsePattern& pattern);

/// Analyses a symmetric matrix whose unknowns are in the elimination ordering; without `position` and `updates`. Some
/// entries that stay zero are included for wider supernodes.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @param n_last the number of last unknowns, which always form one supernode.
/// @param tree if already known, as `order_elimination` returns it (without `n_last`); otherwise empty.
/// @param row_indices receives, per entry of the matrix, the index of its column among the rows of its row's supernode.
/// @param most_columns of a supernode, except for that of the last unknowns.
SymbolicFactor make_symmetric_symbolic_factor(const SparsePattern& upper, Index n_last, const EliminationTree& tree,
                                              std::vector<Index>& row_indices,
                                              Index most_columns = std::numeric_limits<Index>::max());

}  // namespace seamflow
