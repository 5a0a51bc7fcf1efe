#include "partition/cut/divide.h"

#include <algorithm>
#include <numeric>

#include "partition/index.h"

namespace seamflow {

namespace {

/// METIS divides so many at once.
constexpr Index max_parts_at_once = 64;
/// Where there are more, into so many groups.
constexpr Index n_groups = 20;

/// Divides k among the components in proportion to their weights, by largest remainders. Components that would go empty
/// get one part on top, so that the others are cut as finely as k asks however many small components there are.
/// @param due the weight of every component.
std::vector<Index> share_out(std::vector<double> due, Index k)
{
    const double total = std::accumulate(due.begin(), due.end(), 0.0);
    std::vector<Index> share(due.size());
    Index left = k;
    for (std::size_t c = 0; c < due.size(); ++c) {
        due[c] *= k / total;
        share[c] = static_cast<Index>(due[c]);
        left -= share[c];
    }
    std::vector<std::size_t> by_remainder(due.size());
    std::iota(by_remainder.begin(), by_remainder.end(), std::size_t{0});
    std::stable_sort(by_remainder.begin(), by_remainder.end(),
                     [&](std::size_t a, std::size_t b) { return due[a] - share[a] > due[b] - share[b]; });
    for (std::size_t i = 0; i < by_remainder.size() && left > 0; ++i, --left)
        ++share[by_remainder[i]];
    for (Index& parts : share)
        parts = std::max(Index{1}, parts);
    return share;
}

std::vector<Index> divide_connected(const FaceGraph& graph, Index k, Afterwards afterwards);

/// Divides the part of the graph that each label names further, into the number of parts that it counts for.
/// @returns the new labels, those of the first part before those of the second.
std::vector<Index> divide_further(const FaceGraph& graph, std::span<const Index> labels, std::span<const Index> shares,
                                  Afterwards afterwards)
{
    const auto graphs = induced_subgraphs(graph, labels, static_cast<Index>(shares.size()));
    std::vector<Index> result(labels.size());
    std::vector<std::vector<Index>> of_part(graphs.size());
    std::vector<Index> first_label(graphs.size(), 0);
    for (std::size_t i = 0; i < graphs.size(); ++i) {
        of_part[i] = divide_connected(graphs[i], shares[i], afterwards);
        if (i > 0)
            first_label[i] = first_label[i - 1] + shares[i - 1];
    }
    std::vector<std::size_t> next(graphs.size(), 0);
    for (std::size_t node = 0; node < labels.size(); ++node) {
        const auto part = at(labels[node]);
        result[node] = first_label[part] + of_part[part][next[part]++];
    }
    return result;
}

std::vector<Index> divide_connected(const FaceGraph& graph, Index k, Afterwards afterwards)
{
    if (k <= max_parts_at_once)
        return metis_k_way(graph, std::vector<Index>(k, 1), afterwards);
    std::vector<Index> shares(n_groups);
    for (Index i = 0; i < n_groups; ++i)
        shares[i] = k / n_groups + (i < k % n_groups ? 1 : 0);
    return divide_further(graph, metis_k_way(graph, shares, afterwards), shares, afterwards);
}

}  // namespace

std::vector<Index> divide(const FaceGraph& graph, const Components& components, Index k, Afterwards afterwards)
{
    if (components.count() == 1)
        return divide_connected(graph, k, afterwards);
    const std::vector<Index>& component_of = components.component_of;
    std::vector<double> weight(components.count(), 0.0);
    for (std::size_t node = 0; node < component_of.size(); ++node)
        weight[component_of[node]] += graph.node_weights[node];
    return divide_further(graph, component_of, share_out(std::move(weight), k), afterwards);
}

}  // namespace seamflow
