#include "partition/decomposition/narrow_order.h"

#include <algorithm>

#include "partition/connected_components.h"

namespace seamflow {

namespace {

/// Walks through components of a graph in breadth.
class BreadthFirst {
  public:
    explicit BreadthFirst(const std::vector<std::vector<Index>>& adjacency)
        : adjacency_(&adjacency)
        , reached_in_(adjacency.size(), 0)
    {
    }

    /// All vertices of the component of `start`, those of a vertex by ascending degree.
    std::vector<Index> walk(Index start)
    {
        ++n_walks_;
        std::vector<Index> order;
        reached_in_[start] = n_walks_;
        append_reachable(start, order, [&](Index vertex, auto&& reach) {
            const auto first_new = static_cast<std::ptrdiff_t>(order.size());
            for (const Index neighbour : (*adjacency_)[vertex])
                if (reached_in_[neighbour] != n_walks_) {
                    reached_in_[neighbour] = n_walks_;
                    reach(neighbour);
                }
            std::stable_sort(order.begin() + first_new, order.end(),
                             [&](Index a, Index b) { return (*adjacency_)[a].size() < (*adjacency_)[b].size(); });
        });
        return order;
    }

    [[nodiscard]] bool was_reached(Index vertex) const { return reached_in_[vertex] != 0; }

  private:
    const std::vector<std::vector<Index>>* adjacency_;
    /// Number of the last walk that came by; 0: none.
    std::vector<int> reached_in_;
    int n_walks_ = 0;
};

}  // namespace

std::vector<Index> narrow_order(const std::vector<std::vector<Index>>& adjacency)
{
    BreadthFirst breadth_first(adjacency);
    std::vector<Index> order;
    for (Index start = 0; start < static_cast<Index>(adjacency.size()); ++start) {
        if (breadth_first.was_reached(start))
            continue;
        const Index far_end = breadth_first.walk(breadth_first.walk(start).back()).back();
        const std::vector<Index> component = breadth_first.walk(far_end);
        order.insert(order.end(), component.begin(), component.end());
    }
    std::reverse(order.begin(), order.end());
    return order;
}

}  // namespace seamflow
