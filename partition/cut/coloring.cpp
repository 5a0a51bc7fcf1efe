#include "partition/cut/coloring.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

#include "partition/index.h"

namespace seamflow {

namespace {

/// The labels around a vertex, ascending, each once.
void labels_around(const Topology& topology, std::span<const Index> labels, Index v, std::vector<Index>& around)
{
    around.clear();
    for (const Index corner : topology.corners_at(v))
        if (const Index label = labels[at(topology.face_of[at(corner)])]; around.empty() || around.back() != label)
            around.push_back(label);
    if (around.size() < 2)
        return;
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
}

/// Gives alternating colours to the connected component of `root` and lists its nodes.
/// @returns false if there is a cycle of odd length; the colours are then no colouring.
bool color_alternately(const Adjacency& adjacency, Index root, std::vector<Index>& colors, std::vector<Index>& nodes)
{
    nodes.assign(1, root);
    colors[at(root)] = 0;
    bool bipartite = true;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Index color = colors[at(nodes[i])];
        for (const Index neighbour : adjacency[at(nodes[i])]) {
            if (colors[at(neighbour)] < 0) {
                colors[at(neighbour)] = 1 - color;
                nodes.push_back(neighbour);
            } else if (colors[at(neighbour)] == color) {
                bipartite = false;
            }
        }
    }
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
        return Urgency(-saturation[at(node)], -static_cast<Index>(adjacency[at(node)].size()), node);
    };
    std::set<Urgency> waiting;
    for (const Index node : nodes) {
        colors[at(node)] = -1;
        waiting.insert(urgency(node));
    }
    while (!waiting.empty()) {
        const Index node = std::get<2>(*waiting.begin());
        waiting.erase(waiting.begin());
        const Index color = lowest_free(taken[at(node)]);
        colors[at(node)] = color;
        for (const Index neighbour : adjacency[at(node)]) {
            auto& colors_taken = taken[at(neighbour)];
            if (colors_taken.size() <= at(color))
                colors_taken.resize(at(color) + 1, false);
            if (colors_taken[at(color)])
                continue;
            const bool still_waiting = waiting.erase(urgency(neighbour)) > 0;
            colors_taken[at(color)] = true;
            ++saturation[at(neighbour)];
            if (still_waiting)
                waiting.insert(urgency(neighbour));
        }
    }
}

}  // namespace

Adjacency adjacency_of(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts)
{
    std::vector<std::pair<Index, Index>> pairs;
    std::vector<Index> around;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (!topology.moves(v))
            continue;
        labels_around(topology, labels, v, around);
        for (std::size_t i = 0; i < around.size(); ++i)
            for (std::size_t j = i + 1; j < around.size(); ++j)
                pairs.emplace_back(around[i], around[j]);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    Adjacency adjacency(at(n_parts));
    for (const auto& [low, high] : pairs) {
        adjacency[at(low)].push_back(high);
        adjacency[at(high)].push_back(low);
    }
    for (auto& neighbours : adjacency)
        std::sort(neighbours.begin(), neighbours.end());
    return adjacency;
}

std::vector<Index> color(const Adjacency& adjacency)
{
    std::vector<Index> colors(adjacency.size(), -1);
    std::vector<Index> nodes;
    for (Index root = 0; root < static_cast<Index>(adjacency.size()); ++root)
        if (colors[at(root)] < 0 && !color_alternately(adjacency, root, colors, nodes))
            color_by_saturation(adjacency, nodes, colors);
    return colors;
}

Index n_colors(std::span<const Index> colors)
{
    return colors.empty() ? 0 : *std::max_element(colors.begin(), colors.end()) + 1;
}

}  // namespace seamflow
