#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/decomposition/sweep_plan.h"

namespace seamflow {

/// How many factors live at once: sub-meshes are factorised in a fixed order, and the one at place i + size waits until
/// the one at place i has been solved, when its factor is gone.
struct FactorWindow {
    /// The sub-meshes in the order in which they are factorised; adjacent ones are near each other.
    std::vector<Index> order;
    Index size = 0;
};

/// The smallest window with which a sweep along this order does not wait for itself: a sub-mesh cannot be solved before
/// those whose results or predictions it takes over have been factorised.
Index least_window(const SweepPlan& plan, const std::vector<Index>& order);

}  // namespace seamflow
