#include "partition/cut/loose_nodes.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "partition/index.h"

namespace seamflow {

namespace {

/// The connected components of all parts.
Components components_of_parts(const FaceGraph& graph, const std::vector<Index>& labels)
{
    return connected_components(graph.n_nodes(), [&](Index node, auto&& visit) {
        for (const Index neighbour : graph.neighbours(node))
            if (labels[neighbour] == labels[node])
                visit(neighbour);
    });
}

/// One entry per component: whether it is the heaviest of its part.
std::vector<bool> find_heaviest(const FaceGraph& graph, const Components& components, Index n_labels,
                                const std::vector<Index>& labels)
{
    std::vector<std::int64_t> weight(components.count(), 0);
    for (Index node = 0; node < graph.n_nodes(); ++node)
        weight[components.component_of[node]] += graph.node_weights[node];
    const auto label_of = [&](Index component) { return labels[components.nodes[component].front()]; };
    std::vector<Index> heaviest(n_labels, -1);
    for (Index component = 0; component < components.count(); ++component) {
        Index& best = heaviest[label_of(component)];
        if (best < 0 || weight[component] > weight[best])
            best = component;
    }
    std::vector<bool> is_heaviest(weight.size());
    for (Index component = 0; component < components.count(); ++component)
        is_heaviest[component] = heaviest[label_of(component)] == component;
    return is_heaviest;
}

}  // namespace

bool join_loose_nodes(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels)
{
    const Components components = components_of_parts(graph, labels);
    std::vector<bool> settled = find_heaviest(graph, components, n_labels, labels);
    std::vector<Index> loose;
    for (Index component = 0; component < components.count(); ++component)
        if (!settled[component])
            loose.push_back(component);
    // A component with none but loose ones around it waits for them.
    const auto join = [&](Index component) {
        std::map<Index, std::int64_t> shared;
        for (const Index node : components.nodes[component])
            for (Index arc = graph.offsets[node]; arc < graph.offsets[node + 1]; ++arc)
                if (const Index target = graph.targets[arc]; settled[components.component_of[target]])
                    shared[labels[target]] += graph.arc_weights[arc];
        if (shared.empty())
            return false;
        const auto best = std::max_element(shared.begin(), shared.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        for (const Index node : components.nodes[component])
            labels[node] = best->first;
        settled[component] = true;
        return true;
    };
    const bool any = !loose.empty();
    while (!loose.empty())
        std::erase_if(loose, join);
    return any;
}

}  // namespace seamflow
