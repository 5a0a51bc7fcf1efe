#include "partition/cut/metis.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <string>

#include <metis.h>

#include "partition/errors.h"
#include "partition/index.h"

namespace seamflow {

namespace {

constexpr idx_t seed = 20230;
/// With fewer nodes per part than this, recursive bisection takes a third of the time of k-way partitioning and cuts up
/// to a third less. With more, k-way cuts up to a tenth less, and unlike bisection it keeps parts connected.
constexpr Index min_nodes_per_part_k_way = 50;

/// METIS draws from the C library's random numbers and installs signal handlers: one caller at a time.
std::mutex& metis_mutex()
{
    static std::mutex mutex;
    return mutex;
}

std::array<idx_t, METIS_NOPTIONS> options(bool k_way)
{
    std::array<idx_t, METIS_NOPTIONS> result{};
    METIS_SetDefaultOptions(result.data());
    result[METIS_OPTION_NUMBERING] = 0;
    result[METIS_OPTION_SEED] = seed;
    if (k_way)
        result[METIS_OPTION_CONTIG] = 1;
    return result;
}

std::vector<idx_t> copy(const std::vector<Index>& from)
{
    return {from.begin(), from.end()};
}

}  // namespace

std::vector<Index> metis_k_way(const FaceGraph& graph, Index k)
{
    if (k < 1)
        throw OptionError("the number of parts is " + std::to_string(k) + ", but must be at least 1");
    std::vector<idx_t> labels(at(graph.n_nodes()), 0);
    k = std::min(k, graph.n_nodes());
    if (k > 1) {
        const std::lock_guard lock(metis_mutex());
        const bool k_way = graph.n_nodes() / k >= min_nodes_per_part_k_way;
        auto settings = options(k_way);
        auto offsets = copy(graph.offsets);
        auto targets = copy(graph.targets);
        auto arc_weights = copy(graph.arc_weights);
        auto node_weights = copy(graph.node_weights);
        idx_t n_nodes = graph.n_nodes();
        idx_t n_constraints = 1;
        idx_t n_parts = k;
        idx_t cut_weight = 0;
        const auto partition = k_way ? METIS_PartGraphKway : METIS_PartGraphRecursive;
        const int status =
            partition(&n_nodes, &n_constraints, offsets.data(), targets.data(), node_weights.data(), nullptr,
                      arc_weights.data(), &n_parts, nullptr, nullptr, settings.data(), &cut_weight, labels.data());
        if (status != METIS_OK)
            throw ComputationError("METIS could not divide " + std::to_string(n_nodes) + " faces into " +
                                   std::to_string(k) + " parts (METIS status " + std::to_string(status) +
                                   "); try another number of parts");
    }
    return {labels.begin(), labels.end()};
}

}  // namespace seamflow
