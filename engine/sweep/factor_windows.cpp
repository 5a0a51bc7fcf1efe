#include "engine/sweep/factor_windows.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// Calls visit(t) for each sub-mesh t that solves before s in the sweep and whose Vᵏ⁺¹ on Γ is then used by s: t leads,
/// and s follows.
template <class Visit>
void for_each_leader(const SweepPlan& plan, Index s, Visit&& visit)
{
    for (const auto* transfers : {&plan.traces[s], &plan.copies[s]})
        for (const Transfer& transfer : *transfers)
            if (plan.stage[transfer.from] < plan.stage[s])
                visit(transfer.from);
}

/// The sub-meshes in the order of the sweep.
std::vector<Index> by_stage(const SweepPlan& plan)
{
    std::vector<Index> sub_meshes(plan.stage.size());
    std::iota(sub_meshes.begin(), sub_meshes.end(), 0);
    std::ranges::stable_sort(sub_meshes, {}, [&](Index s) { return plan.stage[s]; });
    return sub_meshes;
}

}  // namespace

std::vector<Index> order_by_need(const SweepPlan& plan, const std::vector<Index>& order)
{
    const std::vector<Index> indices = inverse(order);
    // For each sub-mesh s, the lowest index in `order` among s and all sub-meshes that wait, directly or through
    // others, for the solution of s; and then also among those that use a prediction by the factor of s.
    std::vector<Index> first_after_solution = indices;
    std::vector<Index> sweep = by_stage(plan);
    for (auto s = sweep.rbegin(); s != sweep.rend(); ++s)
        for_each_leader(plan, *s, [&](Index leader) {
            first_after_solution[leader] = std::min(first_after_solution[leader], first_after_solution[*s]);
        });
    std::vector<Index> first_after_factor = first_after_solution;
    for (const Index s : sweep)
        for (const Transfer& prediction : plan.predictions[s])
            first_after_factor[prediction.from] =
                std::min(first_after_factor[prediction.from], first_after_solution[s]);
    std::ranges::stable_sort(sweep, {}, [&](Index s) { return first_after_factor[s]; });
    return sweep;
}

FactorWindow least_window(const SweepPlan& plan, std::vector<Index> order)
{
    const std::vector<Index> indices = inverse(order);
    // Per sub-mesh, the last index that must be factorised before it can be solved.
    std::vector<Index> last = indices;
    FactorWindow window{.order = std::move(order), .freed = by_stage(plan)};
    for (const Index s : window.freed) {
        for (const Transfer& prediction : plan.predictions[s])
            last[s] = std::max(last[s], indices[prediction.from]);
        for_each_leader(plan, s, [&](Index leader) { last[s] = std::max(last[s], last[leader]); });
    }
    std::ranges::stable_sort(window.freed, {}, [&](Index s) { return last[s]; });
    // When freed[i] is to be solved, i factors have been freed: the window must then reach to the index last[freed[i]].
    for (std::size_t i = 0; i < last.size(); ++i)
        window.size = std::max(window.size, last[window.freed[i]] - static_cast<Index>(i) + 1);
    return window;
}

void choose_size(std::vector<FactorWindow>& windows, std::size_t factor_bytes, bool keeps_all, Index n_threads,
                 std::optional<std::size_t> memory_limit)
{
    constexpr Index slots_per_thread = 4;
    const auto n = static_cast<Index>(windows.front().order.size());
    Index least = 0;
    for (const FactorWindow& window : windows)
        least = std::max(least, window.size);
    least = keeps_all ? n : std::min(least, n);
    const auto resize = [&](Index size) {
        for (FactorWindow& window : windows)
            window.size = size;
    };
    const Index enough = std::min(n, least + slots_per_thread * n_threads);
    resize(enough);
    if (!memory_limit)
        return;
    const std::size_t slots = *memory_limit / factor_bytes;
    if (slots < usize(least))
        throw MemoryLimitError(Wording{"<memory_limit> is " + std::to_string(*memory_limit) + " bytes, but the " +
                                       std::to_string(least) + " factorisations that a step needs at once take " +
                                       std::to_string(usize(least) * factor_bytes) +
                                       ": raise it, or use more sub-meshes"});
    resize(static_cast<Index>(std::min(usize(enough), slots)));
}

}  // namespace seamflow
