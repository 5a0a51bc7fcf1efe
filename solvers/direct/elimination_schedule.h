#pragma once

#include <vector>

#include "partition/index_lists.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// A plan for several threads to factorise the supernodes of a matrix: groups of subtrees of the elimination tree,
/// which do not depend on each other, and then the supernodes above them one by one. It follows from the pattern alone.
/// A small matrix has no plan, because threads would not help.
struct EliminationSchedule {
    /// Groups of about the same work: the supernodes of some subtrees, ascending.
    IndexLists groups;
    /// The supernodes above the groups, ascending.
    std::vector<Index> above;
    /// Per supernode, its index in `above`; -1 if it is in a group.
    std::vector<Index> index_above;

    [[nodiscard]] bool exists() const { return groups.size() > 1; }
};

/// @param supernode_of per unknown: its supernode.
EliminationSchedule schedule_elimination(const SymbolicFactor& pattern, const std::vector<Index>& supernode_of);

}  // namespace seamflow
