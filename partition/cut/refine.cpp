#include "partition/cut/refine.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

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

/// The most rounds over all nodes. Later rounds move hardly any nodes.
constexpr int max_rounds = 8;
/// The most times that nodes are moved and loose components then joined.
constexpr int max_passes = 3;

std::vector<std::int64_t> weights_of_parts(const FaceGraph& graph, Index n_labels, const std::vector<Index>& labels)
{
    std::vector<std::int64_t> weights(n_labels, 0);
    for (std::size_t node = 0; node < labels.size(); ++node)
        weights[labels[node]] += graph.node_weights[node];
    return weights;
}

/// Moves single nodes between parts (see refine).
class Refiner {
  public:
    Refiner(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels)
        : graph_(graph)
        , labels_(labels)
        , weight_(weights_of_parts(graph, n_labels, labels))
        , shared_(n_labels, 0)
    {
    }

    /// Moves a node to a better part.
    /// @returns whether the node changed its label.
    bool improve(Index node)
    {
        const Index own = labels_[node];
        candidates_.assign(1, own);
        for (Index arc = graph_.offsets[node]; arc < graph_.offsets[node + 1]; ++arc) {
            const Index label = labels_[graph_.targets[arc]];
            if (shared_[label] == 0 && label != own)
                candidates_.push_back(label);
            shared_[label] += graph_.arc_weights[arc];
        }
        Index best = own;
        // A node without arcs to its own part stays: it may be the only node of the part.
        if (shared_[own] > 0)
            for (const Index label : candidates_)
                if (is_better(node, label, best))
                    best = label;
        for (const Index label : candidates_)
            shared_[label] = 0;
        weight_.move(graph_.node_weights[node], own, best);
        labels_[node] = best;
        return best != own;
    }

  private:
    /// Whether to move the node to part `label` rather than to `other`, which may be the node's own part.
    [[nodiscard]] bool is_better(Index node, Index label, Index other) const
    {
        const Index own = labels_[node];
        if (label == own)
            return false;
        const Index weight = graph_.node_weights[node];
        if (weight_.relieves(weight, own, label))
            return other == own || shared_[label] > shared_[other];
        return weight_.stay_balanced(weight, own, label) && shared_[label] > shared_[other];
    }

    const FaceGraph& graph_;
    std::vector<Index>& labels_;
    PartWeights weight_;
    /// One entry per label, 0 between calls: the weight of the arcs from the current node to the part.
    std::vector<std::int64_t> shared_;
    /// Scratch: the label of the current node, and the other labels of its neighbours.
    std::vector<Index> candidates_;
};

/// Moves nodes to better parts in rounds, until none moves or after max_rounds.
void move_nodes(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels)
{
    Refiner refiner(graph, n_labels, labels);
    for (int round = 0; round < max_rounds; ++round) {
        bool moved = false;
        for (Index node = 0; node < graph.n_nodes(); ++node)
            moved = refiner.improve(node) || moved;
        if (!moved)
            return;
    }
}

}  // namespace

PartWeights::PartWeights(std::vector<std::int64_t> weights)
    : weights_(std::move(weights))
{
    const auto total = static_cast<double>(std::accumulate(weights_.begin(), weights_.end(), std::int64_t{0}));
    const double mean = total / static_cast<double>(weights_.size());
    heaviest_ = static_cast<std::int64_t>(mean * (1.0 + balance_tolerance));
    lightest_ = static_cast<std::int64_t>(mean / (1.0 + balance_tolerance));
}

bool join_loose_components(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels)
{
    const Components components = components_of_parts(graph, labels);
    std::vector<bool> settled = find_heaviest(graph, components, n_labels, labels);
    std::vector<Index> loose;
    for (Index component = 0; component < components.count(); ++component)
        if (!settled[component])
            loose.push_back(component);
    // A component that has only loose components around it waits until they are joined.
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

void refine(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels)
{
    join_loose_components(graph, n_labels, labels);
    // Moved nodes may leave loose components behind, and joining these may spoil the balance.
    for (int pass = 0; pass < max_passes; ++pass) {
        move_nodes(graph, n_labels, labels);
        if (!join_loose_components(graph, n_labels, labels))
            return;
    }
}

}  // namespace seamflow
