#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/sweep/sweep_plan.h"

namespace seamflow {

/// A limit on the factors that live at once. Sub-meshes are factorised in a fixed order: order[i + size] waits until
/// freed[i] has been solved and its factor is freed.
struct FactorWindow {
    /// The sub-meshes in the order of factorisation.
    std::vector<Index> order;
    /// The same sub-meshes in an order in which they can be solved meanwhile.
    std::vector<Index> freed;
    /// The most factors that live at once.
    Index size = 0;
};

/// An order in which few factors live at once: each sub-mesh comes shortly before the first solve that needs it.
/// @param order of the same sub-meshes, in which adjacent sub-meshes are near each other.
std::vector<Index> order_by_need(const SweepPlan& plan, const std::vector<Index>& order);

/// The smallest window with which a sweep in this order cannot deadlock: a sub-mesh is solved only after the sub-meshes
/// whose results or predictions it uses have been factorised.
FactorWindow least_window(const SweepPlan& plan, std::vector<Index> order);

/// Chooses the size of the windows of the sweeps forward and backward: large enough that each thread has work within
/// the window, as far as the limit allows; at least as large as is needed to avoid deadlocks.
/// @param windows one for each sweep, with the smallest sizes; receives the size chosen, the same for all.
/// @param factor_bytes the size of the largest factor. @param keeps_all whether all factors live until the step ends.
/// @param n_threads the number of threads. @param memory_limit in bytes, of all factors at once; nullopt: no limit.
/// @throws MemoryLimitError if the limit is too low.
void choose_size(std::vector<FactorWindow>& windows, std::size_t factor_bytes, bool keeps_all, Index n_threads,
                 std::optional<std::size_t> memory_limit);

}  // namespace seamflow
