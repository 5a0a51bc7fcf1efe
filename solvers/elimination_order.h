#pragma once

#include <vector>

#include "solvers/sparse_pattern.h"

namespace seamflow {

/// An order of elimination with little fill-in for symmetric matrices of this pattern (approximate minimum degree,
/// postordered): entry i is the i-th unknown to be eliminated.
/// @param upper the entries on and above the diagonal.
/// @throws ComputationError if there is too little memory for it.
std::vector<Index> elimination_order(const SparsePattern& upper);

/// The same with some unknowns last.
/// @param is_last one per unknown.
std::vector<Index> elimination_order(const SparsePattern& upper, const std::vector<bool>& is_last);

}  // namespace seamflow
