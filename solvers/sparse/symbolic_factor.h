#pragma once

#include <limits>
#include <vector>

#include "partition/index_lists.h"
#include "solvers/sparse/elimination_ordering.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// The entries of the factors L and U of a matrix that may be nonzero if every pivot is taken from the diagonal, with
/// the matrix's pattern made symmetric. Unknowns are numbered in the elimination ordering, and gathered into supernodes
/// of consecutive ones, whose columns of L have the same rows except for each other. The rows of U are those columns,
/// transposed.
struct SymbolicFactor {
    /// An update of one column of L, and one row of U, by a supernode of earlier ones.
    struct Update {
        Index supernode;
        /// Where the column stands among the supernode's rows.
        Index place;
    };

    /// Per unknown of the matrix, its number in the elimination ordering; empty where they are the same.
    std::vector<Index> position;
    /// Number of supernodes + 1: the first unknown of each.
    std::vector<Index> first{0};
    /// Per supernode: its unknowns, then all others on which its columns have entries, ascending.
    IndexLists rows;
    /// Number of unknowns + 1, and the updates of each unknown's column from outside its supernode.
    std::vector<Index> update_offsets;
    std::vector<Update> updates;

    [[nodiscard]] Index n() const { return first.back(); }
    [[nodiscard]] Index n_supernodes() const { return static_cast<Index>(first.size()) - 1; }
    [[nodiscard]] Index width(Index supernode) const { return first[supernode + 1] - first[supernode]; }
};

/// For a matrix of any pattern, in an elimination ordering of its own.
/// @throws ComputationError if there is too little memory.
SymbolicFactor make_symbolic_factor(const SparsePattern& pattern);

/// For a symmetric matrix whose unknowns are in the elimination ordering, without `position` and `updates`. A few
/// entries that stay zero are included for wider supernodes.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @param n_last the last unknowns, which always form one supernode.
/// @param tree if already known, as `order_elimination` returns it (without `n_last`); otherwise empty.
/// @param places receives, per entry of the matrix, the place of its column among the rows of its row's supernode.
/// @param most_columns of a supernode, but for that of the last unknowns.
SymbolicFactor make_symmetric_symbolic_factor(const SparsePattern& upper, Index n_last, const EliminationTree& tree,
                                              std::vector<Index>& places,
                                              Index most_columns = std::numeric_limits<Index>::max());

}  // namespace seamflow
