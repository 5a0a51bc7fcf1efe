#include "partition/decomposition/reverse_cuthill_mckee.h"

#include <algorithm>

#include "partition/connected_components.h"

namespace seamflow {

std::vector<Index> reverse_cuthill_mckee(const std::vector<std::vector<Index>>& adjacency)
{
    // Per vertex, the number of the last walk that reached it; 0: none.
    std::vector<int> reached_in(adjacency.size(), 0);
    int n_walks = 0;
    // The vertices of a component, breadth first; the vertices reached from one vertex are in ascending order of their
    // degrees.
    const auto walk = [&](Index start) {
        ++n_walks;
        std::vector<Index> order;
        reached_in[start] = n_walks;
        append_reachable(start, order, [&](Index vertex, auto&& reach) {
            const auto first_new = static_cast<std::ptrdiff_t>(order.size());
            for (const Index neighbour : adjacency[vertex])
                if (reached_in[neighbour] != n_walks) {
                    reached_in[neighbour] = n_walks;
                    reach(neighbour);
                }
            std::stable_sort(order.begin() + first_new, order.end(),
                             [&](Index a, Index b) { return adjacency[a].size() < adjacency[b].size(); });
        });
        return order;
    };
    std::vector<Index> order;
    for (Index start = 0; start < static_cast<Index>(adjacency.size()); ++start) {
        if (reached_in[start] != 0)
            continue;
        // The vertex that a walk reaches last is among the farthest: after two walks, it is at a far end.
        const Index far_end = walk(walk(start).back()).back();
        const std::vector<Index> component = walk(far_end);
        order.insert(order.end(), component.begin(), component.end());
    }
    std::reverse(order.begin(), order.end());
    return order;
}

}  // namespace seamflow
