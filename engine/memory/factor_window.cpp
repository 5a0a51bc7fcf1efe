#include "engine/memory/factor_window.h"

#include <algorithm>
#include <numeric>

namespace seamflow {

namespace {

std::vector<Index> places_in(const std::vector<Index>& order)
{
    std::vector<Index> places(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        places[order[i]] = static_cast<Index>(i);
    return places;
}

std::vector<Index> by_rank(const SweepPlan& plan)
{
    std::vector<Index> sub_meshes(plan.rank.size());
    std::iota(sub_meshes.begin(), sub_meshes.end(), 0);
    std::stable_sort(sub_meshes.begin(), sub_meshes.end(),
                     [&](Index s, Index t) { return plan.rank[s] < plan.rank[t]; });
    return sub_meshes;
}

}  // namespace

Index least_window(const SweepPlan& plan, const std::vector<Index>& order)
{
    const std::vector<Index> places = places_in(order);
    // Per sub-mesh, the last place that must be factorised before it can be solved.
    std::vector<Index> last = places;
    Index window = 0;
    for (const Index s : by_rank(plan)) {
        for (const Transfer& prediction : plan.predictions[s])
            last[s] = std::max(last[s], places[prediction.from]);
        for (const auto* transfers : {&plan.traces[s], &plan.copies[s]})
            for (const Transfer& transfer : *transfers)
                if (plan.rank[transfer.from] < plan.rank[s])
                    last[s] = std::max(last[s], last[transfer.from]);
        window = std::max(window, last[s] - places[s] + 1);
    }
    return window;
}

}  // namespace seamflow
