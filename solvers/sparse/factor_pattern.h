#pragma once

#include <vector>

#include "partition/index_lists.h"
#include "solvers/sparse/elimination_order.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// Which entries of the factors L and U of a matrix may be different from zero if every pivot is taken from the
/// diagonal, with the matrix's pattern made symmetric. Unknowns are numbered in the order of elimination, and gathered
/// into blocks of consecutive ones whose columns of L have the same rows but for each other (supernodes). The rows of U
/// are those columns, transposed.
struct FactorPattern {
    /// An update of one column of L, and one row of U, by a block of earlier ones.
    struct Update {
        Index block;
        /// Where the column stands among the block's rows.
        Index place;
    };

    /// Per unknown of the matrix, its number in the order of elimination; empty where they are the same.
    std::vector<Index> position;
    /// Number of blocks + 1: the first unknown of each.
    std::vector<Index> first{0};
    /// Per block: its unknowns, then all others on which its columns have entries, ascending.
    IndexLists rows;
    /// Number of unknowns + 1, and the updates of each unknown's column from outside its block.
    std::vector<Index> update_offsets;
    std::vector<Update> updates;

    [[nodiscard]] Index n() const { return first.back(); }
    [[nodiscard]] Index n_blocks() const { return static_cast<Index>(first.size()) - 1; }
    [[nodiscard]] Index width(Index block) const { return first[block + 1] - first[block]; }
};

/// For a matrix of any pattern, in an order of elimination of its own.
/// @throws ComputationError if there is too little memory.
FactorPattern make_factor_pattern(const SparsePattern& pattern);

/// For a symmetric matrix whose unknowns are in the order of elimination, without `position` and `updates`. A few
/// entries that stay zero are taken in for wider blocks.
/// @param upper the entries on and above the diagonal, the whole diagonal among them.
/// @param n_last the last unknowns, which are made one block in any case.
/// @param tree where it is known already, as `eliminate` makes it (without `n_last`); otherwise empty.
/// @param places receives, per entry of the matrix, where its column stands among the rows of its row's block.
FactorPattern make_symmetric_factor_pattern(const SparsePattern& upper, Index n_last, const EliminationTree& tree,
                                            std::vector<Index>& places);

}  // namespace seamflow
