#include "engine/distributed/cut/cluster_division.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "engine/distributed/parts/element_ranges.h"
#include "partition/connected_components.h"
#include "partition/cut/divide.h"
#include "partition/cut/refine.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

struct Block {
    /// The rank that divides it: the one that has its first chunk.
    int rank = 0;
    /// The first of its clusters and the one behind the last.
    Index begin = 0;
    Index end = 0;
    /// The number of its parts.
    Index n_parts = 0;

    [[nodiscard]] bool has(Index cluster) const { return cluster >= begin && cluster < end; }
};

struct ChunkSize {
    std::int64_t weight;
    Index n_clusters;
    std::int32_t rank;
};

/// Sizes of all chunks.
std::vector<ChunkSize> gather_sizes(Communicator& comm, const ClusterShare& clusters)
{
    std::vector<ChunkSize> own;
    auto weight = clusters.weights.begin();
    for (const Index n : clusters.of_chunk) {
        own.push_back({std::accumulate(weight, weight + n, std::int64_t{0}), n, comm.rank()});
        weight += n;
    }
    return comm.gather_all(own);
}

/// Blocks of about as many chunks each, with parts in proportion to their weight.
std::vector<Block> make_blocks(const std::vector<ChunkSize>& chunks, Index k, Index chunks_of_block)
{
    const auto n_chunks = static_cast<Index>(chunks.size());
    const Index n_blocks = std::min(k, (n_chunks - 1) / chunks_of_block + 1);
    double total = 0.0;
    for (const ChunkSize& chunk : chunks)
        total += static_cast<double>(chunk.weight);
    std::vector<Block> blocks;
    double weight_before = 0.0;
    Index n_parts_before = 0;
    auto chunk = chunks.begin();
    for (std::int64_t b = 0; b < n_blocks; ++b) {
        const Index begin = blocks.empty() ? 0 : blocks.back().end;
        Block block{.rank = chunk->rank, .begin = begin, .end = begin};
        for (const auto end = chunks.begin() + (b + 1) * n_chunks / n_blocks; chunk != end; ++chunk) {
            block.end += chunk->n_clusters;
            weight_before += static_cast<double>(chunk->weight);
        }
        block.n_parts = std::max(static_cast<Index>(std::lround(k * weight_before / total)) - n_parts_before, 1);
        n_parts_before += block.n_parts;
        blocks.push_back(block);
    }
    return blocks;
}

/// Sends contacts to the ranks that divide one of their two clusters.
std::vector<ClusterContact> deal_contacts(Communicator& comm, const std::vector<Block>& blocks,
                                          const std::vector<ClusterContact>& own)
{
    const auto rank_of = [&](Index cluster) {
        return std::ranges::upper_bound(blocks, cluster, {}, &Block::end)->rank;
    };
    std::vector<std::vector<ClusterContact>> to_each(comm.size());
    for (const ClusterContact& one : own) {
        const int rank = rank_of(one.low);
        to_each[rank].push_back(one);
        if (const int other = rank_of(one.high); other != rank)
            to_each[other].push_back(one);
    }
    std::vector<Bytes> sent;
    for (const auto& contacts : to_each)
        sent.push_back(packed(contacts));
    std::vector<ClusterContact> contacts;
    for (const Bytes& bytes : comm.exchange(std::move(sent)))
        Unpacker(bytes).append_all(contacts);
    return contacts;
}

/// The clusters of one block, numbered from 0.
struct BlockGraph {
    std::span<const std::int64_t> weights;
    std::vector<ClusterContact> contacts;
    /// Which clusters have neighbours in other blocks.
    std::vector<std::uint8_t> reaches_out;
};

BlockGraph graph_of(const Block& block, std::span<const std::int64_t> weights,
                    const std::vector<ClusterContact>& contacts)
{
    BlockGraph graph{.weights = weights, .contacts = {}, .reaches_out = std::vector<std::uint8_t>(weights.size(), 0)};
    for (const auto& [low, high, n_edges] : contacts) {
        if (block.has(low) && block.has(high))
            graph.contacts.push_back({low - block.begin, high - block.begin, n_edges});
        else if (block.has(low) || block.has(high))
            graph.reaches_out[(block.has(low) ? low : high) - block.begin] = 1;
    }
    return graph;
}

/// Components that are much smaller than a part and continue in other blocks, except for the heaviest of the block.
/// @returns one entry per cluster: 1 where it is in one of them, else 0.
std::vector<Index> find_shards(const BlockGraph& block, const Components& components, Index k)
{
    std::vector<std::int64_t> weights(at(components.count()), 0);
    std::vector<std::uint8_t> reaches_out(weights.size(), 0);
    for (std::size_t cluster = 0; cluster < block.weights.size(); ++cluster) {
        const auto component = at(components.component_of[cluster]);
        weights[component] += block.weights[cluster];
        reaches_out[component] |= block.reaches_out[cluster];
    }
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / k;
    reaches_out[std::ranges::max_element(weights) - weights.begin()] = 0;
    std::vector<Index> is_shard;
    for (const Index component : components.component_of)
        is_shard.push_back(reaches_out[component] != 0 && static_cast<double>(weights[component]) < 0.5 * mean ? 1 : 0);
    return is_shard;
}

std::vector<Index> divide_graph(const FaceGraph& graph, Index k)
{
    std::vector<Index> labels = divide(graph, graph_components(graph), k, Afterwards::Refined);
    refine(graph, *std::ranges::max_element(labels) + 1, labels);
    return labels;
}

/// Adds the parts of a block.
void divide_block(const BlockGraph& block, Index k, DividedClusters& divided)
{
    const FaceGraph graph = make_face_graph(block.weights, block.contacts);
    const Components components = graph_components(graph);
    divided.n_components += components.count();
    const std::vector<Index> is_shard = find_shards(block, components, k);
    const bool has_shards = std::ranges::find(is_shard, 1) != is_shard.end();
    std::vector<Index> labels =
        has_shards ? divide_graph(induced_subgraphs(graph, is_shard, 2).front(), k) : divide_graph(graph, k);
    const auto first = static_cast<Index>(divided.weights.size());
    divided.weights.resize(at(first + compact_labels(labels)));
    auto label = labels.begin();
    for (std::size_t cluster = 0; cluster < is_shard.size(); ++cluster) {
        divided.labels.push_back(is_shard[cluster] == 1 ? first : first + *label++);
        if (is_shard[cluster] == 0)
            divided.weights[divided.labels.back()] += block.weights[cluster];
    }
    if (has_shards)
        divided.loose_parts.push_back(first);
}

}  // namespace

DividedClusters divide_together(Communicator& comm, const ClusterShare& clusters, Index k, Index chunks_of_block)
{
    const std::vector<Block> blocks = make_blocks(gather_sizes(comm, clusters), k, chunks_of_block);
    const auto contacts = deal_contacts(comm, blocks, clusters.contacts);
    // The clusters that each rank divides.
    std::vector<std::int64_t> bounds(clusters.bounds.size(), 0);
    for (const Block& block : blocks)
        std::fill(bounds.begin() + block.rank + 1, bounds.end(), block.end);
    const std::vector<std::int64_t> weights = move_values(comm, clusters.weights, clusters.bounds, bounds);
    DividedClusters divided;
    for (const Block& block : blocks)
        if (block.rank == comm.rank()) {
            const auto of_block = std::span(weights).subspan(
                at(block.begin) - static_cast<std::size_t>(bounds[block.rank]), at(block.end - block.begin));
            divide_block(graph_of(block, of_block, contacts), block.n_parts, divided);
        }
    const auto first = static_cast<Index>(gather_bounds_of(comm, std::ssize(divided.weights))[comm.rank()]);
    for (std::vector<Index>* const parts : {&divided.labels, &divided.loose_parts})
        for (Index& part : *parts)
            part += first;
    divided.labels = move_values(comm, divided.labels, bounds, clusters.bounds);
    divided.weights = comm.gather_all(divided.weights);
    divided.n_components = static_cast<Index>(gather_bounds_of(comm, divided.n_components).back());
    return divided;
}

}  // namespace seamflow
