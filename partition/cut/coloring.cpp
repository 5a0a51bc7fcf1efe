#include "partition/cut/coloring.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>

#include "partition/connected_components.h"

namespace seamflow {

namespace {

/// Gives alternating colours to the connected component of `root` and lists its nodes.
/// @returns false if there is a cycle of odd length; the colours are then no colouring.
bool color_alternately(const Adjacency& adjacency, Index root, std::vector<Index>& colors, std::vector<Index>& nodes)
{
    nodes.clear();
    colors[root] = 0;
    bool bipartite = true;
    append_reachable(root, nodes, [&](Index node, auto&& reach) {
        const Index color = colors[node];
        for (const Index neighbour : adjacency[node]) {
            if (colors[neighbour] < 0) {
                colors[neighbour] = 1 - color;
                reach(neighbour);
            } else if (colors[neighbour] == color) {
                bipartite = false;
            }
        }
    });
    return bipartite;
}

/// The lowest colour that no neighbour has.
Index lowest_free(const std::vector<bool>& taken)
{
    return static_cast<Index>(std::find(taken.begin(), taken.end(), false) - taken.begin());
}

/// Colours the nodes of a connected component one by one: next is the one whose neighbours have the most different
/// colours, then the one with the most neighbours, then the first.
void color_by_saturation(const Adjacency& adjacency, const std::vector<Index>& nodes, std::vector<Index>& colors)
{
    using Urgency = std::tuple<Index, Index, Index>;
    std::vector<Index> saturation(adjacency.size(), 0);
    std::vector<std::vector<bool>> taken(adjacency.size());
    const auto urgency = [&](Index node) {
        return Urgency(-saturation[node], -static_cast<Index>(adjacency[node].size()), node);
    };
    std::set<Urgency> waiting;
    for (const Index node : nodes) {
        colors[node] = -1;
        waiting.insert(urgency(node));
    }
    while (!waiting.empty()) {
        const Index node = std::get<2>(*waiting.begin());
        waiting.erase(waiting.begin());
        const Index color = lowest_free(taken[node]);
        colors[node] = color;
        for (const Index neighbour : adjacency[node]) {
            auto& colors_taken = taken[neighbour];
            if (colors_taken.size() <= at(color))
                colors_taken.resize(at(color) + 1, false);
            if (colors_taken[color])
                continue;
            const bool still_waiting = waiting.erase(urgency(neighbour)) > 0;
            colors_taken[color] = true;
            ++saturation[neighbour];
            if (still_waiting)
                waiting.insert(urgency(neighbour));
        }
    }
}

}  // namespace

std::vector<Index> color(const Adjacency& adjacency)
{
    std::vector<Index> colors(adjacency.size(), -1);
    std::vector<Index> nodes;
    for (Index root = 0; root < static_cast<Index>(adjacency.size()); ++root)
        if (colors[root] < 0 && !color_alternately(adjacency, root, colors, nodes))
            color_by_saturation(adjacency, nodes, colors);
    return colors;
}

Index n_colors(std::span<const Index> colors)
{
    return colors.empty() ? 0 : *std::max_element(colors.begin(), colors.end()) + 1;
}

}  // namespace seamflow
