#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/decomposition/sweep_plan.h"

namespace seamflow {

/// How many factors live at once. Sub-meshes are factorised in a fixed order: the one at place i + size waits until the
/// one at place i has been solved and its factor is freed.
struct FactorWindow {
    /// The sub-meshes in the order in which they are factorised; adjacent ones are near each other.
    std::vector<Index> order;
    Index size = 0;
};

/// The smallest window with which a sweep along this order cannot deadlock: a sub-mesh is solved only after those whose
/// results or predictions it uses have been factorised.
Index least_window(const SweepPlan& plan, const std::vector<Index>& order);

}  // namespace seamflow
