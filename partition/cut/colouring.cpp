#include "partition/cut/colouring.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>

#include "partition/connected_components.h"

namespace seamflow {

namespace {

/// Gives alternating colours to the connected component of `root` and lists its nodes.
/// @returns false if there is a cycle of odd length; the colours are then no colouring.
bool colour_alternately(const Adjacency& adjacency, Index root, std::vector<Index>& colours, std::vector<Index>& nodes)
{
    nodes.clear();
    colours[root] = 0;
    bool bipartite = true;
    append_reachable(root, nodes, [&](Index node, auto&& reach) {
        const Index colour = colours[node];
        for (const Index neighbour : adjacency[node]) {
            if (colours[neighbour] < 0) {
                colours[neighbour] = 1 - colour;
                reach(neighbour);
            } else if (colours[neighbour] == colour) {
                bipartite = false;
            }
        }
    });
    return bipartite;
}

/// The lowest colour that no neighbour has.
/// @param taken one entry per colour: whether a neighbour has it.
Index lowest_free(const std::vector<bool>& taken)
{
    return static_cast<Index>(std::find(taken.begin(), taken.end(), false) - taken.begin());
}

/// Colours the nodes of a connected component one by one (DSATUR, Brélaz 1979). The next node is the one whose
/// neighbours have the most different colours; of equals the one with the most neighbours; of equals the first.
void colour_by_saturation(const Adjacency& adjacency, const std::vector<Index>& nodes, std::vector<Index>& colours)
{
    using Urgency = std::tuple<Index, Index, Index>;
    std::vector<Index> saturation(adjacency.size(), 0);
    std::vector<std::vector<bool>> taken(adjacency.size());
    const auto urgency = [&](Index node) {
        return Urgency(-saturation[node], -static_cast<Index>(adjacency[node].size()), node);
    };
    std::set<Urgency> waiting;
    for (const Index node : nodes) {
        colours[node] = -1;
        waiting.insert(urgency(node));
    }
    while (!waiting.empty()) {
        const Index node = std::get<2>(*waiting.begin());
        waiting.erase(waiting.begin());
        const Index colour = lowest_free(taken[node]);
        colours[node] = colour;
        for (const Index neighbour : adjacency[node]) {
            auto& colours_taken = taken[neighbour];
            if (colours_taken.size() <= usize(colour))
                colours_taken.resize(usize(colour) + 1, false);
            if (colours_taken[colour])
                continue;
            const bool still_waiting = waiting.erase(urgency(neighbour)) > 0;
            colours_taken[colour] = true;
            ++saturation[neighbour];
            if (still_waiting)
                waiting.insert(urgency(neighbour));
        }
    }
}

}  // namespace

std::vector<Index> colour(const Adjacency& adjacency)
{
    std::vector<Index> colours(adjacency.size(), -1);
    std::vector<Index> nodes;
    for (Index root = 0; root < static_cast<Index>(adjacency.size()); ++root)
        if (colours[root] < 0 && !colour_alternately(adjacency, root, colours, nodes))
            colour_by_saturation(adjacency, nodes, colours);
    return colours;
}

Index n_colours(std::span<const Index> colours)
{
    return colours.empty() ? 0 : *std::max_element(colours.begin(), colours.end()) + 1;
}

}  // namespace seamflow
