#pragma once

#include <vector>

#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// Per column of the factor L of a symmetric matrix whose unknowns are numbered in the elimination ordering: the number
/// of rows below the diagonal; and its parent, a later column that has all of these rows except its own, or -1 if there
/// are none. Entries that stay zero may count, if that gives columns the same rows; the parent may then be unrelated to
/// the column: hardly ever in a mesh, but in graphs such as stars.
struct EliminationTree {
    /// The parent of each column; and the number of rows below the diagonal.
    std::vector<Index> parent;
    std::vector<Index> count;
};

/// An elimination ordering with little fill-in.
struct EliminationOrdering {
    /// order[i] is the i-th unknown to be eliminated.
    std::vector<Index> order;
    /// The tree of the factor; empty if unknown.
    EliminationTree tree;
};

/// Orders by approximate minimum degree, postordered. The tree is unknown if unknowns with very many neighbours were
/// put last without analysis.
/// @param neighbours of a symmetric matrix, all entries off the diagonal; rows in any order.
/// @throws ComputationError if there is too little memory for it.
EliminationOrdering order_elimination(SparsePattern neighbours);

/// An elimination ordering with little fill-in for symmetric matrices of this pattern (approximate minimum degree,
/// postordered): entry i is the i-th unknown to be eliminated.
/// @param upper the entries on and above the diagonal.
/// @param is_last one per unknown: whether it comes last; empty: none does.
/// @throws ComputationError if there is too little memory for it.
std::vector<Index> elimination_ordering(const SparsePattern& upper, const std::vector<bool>& is_last = {});

}  // namespace seamflow
