#pragma once

#include <vector>

#include "partition/index_lists.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// How several threads factorise the supernodes of a matrix: subtrees of its elimination tree at a time, which do not
/// depend on each other, and then those above them one by one. It follows from the pattern alone. A small matrix has
/// none, since threads would not help.
struct EliminationSchedule {
    /// A few groups of about the same work: all supernodes of some subtrees, ascending.
    IndexLists groups;
    /// The other supernodes, ascending.
    std::vector<Index> above;
    /// Per supernode, its place in `above`; -1 if it is in a group.
    std::vector<Index> place_above;

    [[nodiscard]] bool exists() const { return groups.size() > 1; }
};

EliminationSchedule schedule_elimination(const SymbolicFactor& pattern, const std::vector<Index>& supernode_of);

}  // namespace seamflow
