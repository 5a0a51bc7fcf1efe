#include "partition/cut/divide.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>
#include <numeric>
#include <string>

#include <fmt/format.h>
#include <metis.h>

#include "partition/errors.h"
#include "partition/index.h"

namespace seamflow {

namespace {

constexpr idx_t seed = 20230;
/// The fewest nodes per part for k-way partitioning. With fewer, recursive bisection takes a third of the time and cuts
/// up to a third less. With more, k-way cuts up to a tenth less, and unlike bisection it keeps parts connected.
constexpr Index min_nodes_per_part_k_way = 50;
/// The fewest nodes per part for k-way partitioning if parts are refined afterwards: up to about here, bisection leaves
/// interfaces only 0 to 2 percent larger than k-way.
constexpr Index min_nodes_per_refined_part_k_way = 120;

/// METIS draws from the C library's random numbers and installs signal handlers: one caller at a time.
std::mutex& metis_mutex()
{
    static std::mutex mutex;
    return mutex;
}

/// Gives METIS random numbers of its own while this object lives: the caller's rand() then continues as if none had
/// been drawn.
class OwnRandomNumbers {
  public:
    OwnRandomNumbers()
        : callers_(initstate(seed, state_.data(), state_.size()))
    {
    }
    ~OwnRandomNumbers() { setstate(callers_); }
    OwnRandomNumbers(const OwnRandomNumbers&) = delete;
    OwnRandomNumbers& operator=(const OwnRandomNumbers&) = delete;

  private:
    /// The state of METIS's own generator. It has the size of the C library's default state, so that the numbers are
    /// the same.
    alignas(8) std::array<char, 128> state_{};
    /// The state of the caller's generator.
    char* callers_;
};

/// By how many thousandths a group of parts may exceed its weight; the tolerance of its parts (30) is added to this.
constexpr idx_t tolerance_of_groups = 10;

/// The options for METIS; defaults except for the seed and, if asked for, connected parts.
std::array<idx_t, METIS_NOPTIONS> options(bool connected_parts)
{
    std::array<idx_t, METIS_NOPTIONS> result{};
    METIS_SetDefaultOptions(result.data());
    result[METIS_OPTION_NUMBERING] = 0;
    result[METIS_OPTION_SEED] = seed;
    if (connected_parts)
        result[METIS_OPTION_CONTIG] = 1;
    return result;
}

std::vector<idx_t> copy(const std::vector<Index>& from)
{
    return {from.begin(), from.end()};
}

/// The fraction of the total weight for each part; empty if all are equal.
std::vector<real_t> target_weights(std::span<const Index> shares)
{
    if (std::all_of(shares.begin(), shares.end(), [&](Index share) { return share == shares.front(); }))
        return {};
    const auto total = static_cast<double>(std::accumulate(shares.begin(), shares.end(), std::int64_t{0}));
    std::vector<real_t> targets(shares.size());
    std::transform(shares.begin(), shares.end(), targets.begin(),
                   [&](Index share) { return static_cast<real_t>(share / total); });
    return targets;
}

}  // namespace

std::vector<Index> metis_k_way(const FaceGraph& graph, std::span<const Index> shares, Afterwards afterwards)
{
    std::vector<idx_t> labels(graph.n_nodes(), 0);
    auto n_parts = static_cast<idx_t>(std::min(shares.size(), labels.size()));
    if (n_parts > 1) {
        const std::lock_guard lock(metis_mutex());
        const OwnRandomNumbers own;
        const bool k_way =
            graph.n_nodes() / n_parts >=
            (afterwards == Afterwards::Refined ? min_nodes_per_refined_part_k_way : min_nodes_per_part_k_way);
        // METIS refuses to make connected parts from a graph that is not connected.
        auto settings = options(k_way && graph_components(graph).count() == 1);
        // Groups of parts, whose shares exceed 1, have a smaller tolerance.
        if (k_way && *std::max_element(shares.begin(), shares.end()) > 1)
            settings[METIS_OPTION_UFACTOR] = tolerance_of_groups;
        auto offsets = copy(graph.offsets);
        auto targets = copy(graph.targets);
        auto arc_weights = copy(graph.arc_weights);
        auto node_weights = copy(graph.node_weights);
        auto weights = target_weights(shares.first(static_cast<std::size_t>(n_parts)));
        idx_t n_nodes = graph.n_nodes();
        idx_t n_constraints = 1;
        idx_t cut_weight = 0;
        const auto partition = k_way ? METIS_PartGraphKway : METIS_PartGraphRecursive;
        const int status = partition(&n_nodes, &n_constraints, offsets.data(), targets.data(), node_weights.data(),
                                     nullptr, arc_weights.data(), &n_parts, weights.empty() ? nullptr : weights.data(),
                                     nullptr, settings.data(), &cut_weight, labels.data());
        if (status == METIS_ERROR_MEMORY)
            throw std::bad_alloc();
        if (status != METIS_OK)
            throw ComputationError(fmt::format("METIS could not divide a graph of {} nodes into {} parts (METIS status "
                                               "{}); try another number of parts",
                                               n_nodes, n_parts, status));
    }
    return {labels.begin(), labels.end()};
}

namespace {

/// The most parts that METIS makes at once.
constexpr Index max_parts_at_once = 64;
/// The number of groups into which a graph of more parts is divided first.
constexpr Index n_groups = 20;

/// Divides k among the components in proportion to their weights, by largest remainders. Components that would get none
/// receive an extra part, so that the others are cut as finely as k asks however many small components there are.
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
    for (Index& n_parts : share)
        n_parts = std::max(Index{1}, n_parts);
    return share;
}

/// Divides a graph into k parts of about equal weight; into groups of parts first if k is large.
/// @returns one label per node.
std::vector<Index> divide_connected(const FaceGraph& graph, Index k, Afterwards afterwards);

/// Divides the nodes of each label further, into as many parts as the share of the label.
/// @returns the new label of each node: those made from label 0 are the lowest, those from label 1 follow, and so on.
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
        const auto part = usize(labels[node]);
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
