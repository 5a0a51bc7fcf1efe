#include "partition/cut/face_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "partition/index.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

constexpr double mean_arc_weight = 64;

/// Integers proportional to the lengths, each at least 1, whose sum does not exceed max_weight_sum; all are 1 if the
/// sum of the lengths is 0 or not finite.
std::vector<Index> arc_weights(const std::vector<double>& lengths)
{
    double total = 0;
    for (const double length : lengths)
        total += length;
    const auto n_arcs = static_cast<double>(lengths.size());
    if (!std::isfinite(total) || total <= 0)
        return std::vector<Index>(lengths.size(), 1);
    const double scale = std::min(mean_arc_weight * n_arcs, max_weight_sum - n_arcs) / total;
    std::vector<Index> weights(lengths.size());
    std::transform(lengths.begin(), lengths.end(), weights.begin(),
                   [&](double length) { return std::max(Index{1}, static_cast<Index>(length * scale + 0.5)); });
    return weights;
}

/// Σ face_weight in units of `unit`, at least 1 for each face.
Index node_weight(const PolygonMesh& mesh, std::span<const Index> faces, Index unit)
{
    Index weight = 0;
    for (const Index f : faces)
        weight += std::max(Index{1}, face_weight(mesh, f) / unit);
    return weight;
}

/// An arc before its length is converted to an integer.
struct Arc {
    Index target;
    double length;
    /// Arcs are also ordered by length, so that the lengths of shared edges are added in the same order from both
    /// sides.
    friend auto operator<=>(const Arc&, const Arc&) = default;
};

/// Sorts the arcs from `begin` on, and merges those with the same target, adding up their lengths.
void add_up(std::ptrdiff_t begin, std::vector<Arc>& arcs)
{
    std::sort(arcs.begin() + begin, arcs.end());
    auto last = arcs.begin() + begin;
    for (auto arc = last; arc != arcs.end(); ++arc)
        if (arc != last && arc->target == last->target)
            last->length += arc->length;
        else if (arc != last)
            *++last = *arc;
    if (last != arcs.end())
        arcs.erase(last + 1, arcs.end());
}

/// The arcs of one block of nodes, and the number of arcs of each node.
struct BlockOfArcs {
    std::vector<Arc> arcs;
    std::vector<Index> counts;
};

/// Calls append(node, arcs) for all nodes; it appends the arcs of the node, ascending, each once.
template <class Append>
std::vector<BlockOfArcs> list_arcs(Index n_nodes, const Executor& exec, Append&& append)
{
    std::vector<BlockOfArcs> blocks(usize(n_nodes / block_size) + 1);
    for_each_block(exec, n_nodes, [&](Index b, Index begin, Index end) {
        BlockOfArcs& block = blocks[b];
        for (Index node = begin; node < end; ++node) {
            const auto before = std::ssize(block.arcs);
            append(node, block.arcs);
            block.counts.push_back(static_cast<Index>(std::ssize(block.arcs) - before));
        }
    });
    return blocks;
}

/// The arcs between clusters, with the lengths of the shared edges.
std::vector<BlockOfArcs> list_arcs_by_length(const PolygonMesh& mesh, const Topology& topology,
                                             const FaceClusters& clusters, const Executor& exec)
{
    return list_arcs(clusters.size(), exec, [&](Index cluster, std::vector<Arc>& arcs) {
        const auto begin = std::ssize(arcs);
        for (const Index f : clusters.faces[cluster])
            for_each_neighbour(mesh, topology, f, [&](Index h, Index across) {
                if (const Index target = clusters.cluster_of[across]; target != cluster)
                    arcs.push_back({target, edge_length(mesh, topology, h)});
            });
        add_up(begin, arcs);
    });
}

/// Two clusters on either side of an edge.
struct ClusterPair {
    Index low;
    Index high;
};

/// The pairs of clusters at all edges between clusters, by blocks of faces. Each half-edge writes a pair, and most are
/// overwritten: a branch would be hard to predict.
std::vector<std::vector<ClusterPair>> list_cut_edges(const PolygonMesh& mesh, const Topology& topology,
                                                     const FaceClusters& clusters, const Executor& exec)
{
    std::vector<std::vector<ClusterPair>> blocks(usize(mesh.n_faces() / block_size) + 1);
    for_each_block(exec, mesh.n_faces(), [&](Index b, Index begin, Index end) {
        std::vector<ClusterPair> found(mesh.face_offsets[end] - mesh.face_offsets[begin]);
        std::size_t n = 0;
        for (Index f = begin; f < end; ++f) {
            const Index own = clusters.cluster_of[f];
            for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
                const Index twin = topology.twin[h];
                const Index other =
                    clusters.cluster_of[topology.face_of[twin < 0 ? topology.next_at_junction(h) : twin]];
                // The half-edges of a junction form a cycle, which gives each of them a pair; other half-edges give a
                // pair from both sides.
                found[n] = {std::min(own, other), std::max(own, other)};
                n += own < other || (twin < 0 && own != other) ? 1 : 0;
            }
        }
        blocks[b].assign(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n));
    });
    return blocks;
}

/// The arcs between clusters, with the numbers of shared edges as lengths.
std::vector<BlockOfArcs> list_arcs_by_count(const PolygonMesh& mesh, const Topology& topology,
                                            const FaceClusters& clusters, const Executor& exec)
{
    const auto blocks = list_cut_edges(mesh, topology, clusters, exec);
    IndexLists neighbours = make_lists(clusters.size(), [&](auto&& add) {
        for (const auto& pairs : blocks)
            for (const ClusterPair& pair : pairs) {
                add(pair.low, pair.high);
                add(pair.high, pair.low);
            }
    });
    // Clusters are sorted as plain numbers, which is faster than to sort arcs: a cluster has five times as many shared
    // edges as arcs.
    for_each(exec, clusters.size(), [&](Index cluster) {
        const auto begin = neighbours.values.begin();
        std::sort(begin + neighbours.offsets[cluster], begin + neighbours.offsets[cluster + 1]);
    });
    return list_arcs(clusters.size(), exec, [&](Index cluster, std::vector<Arc>& arcs) {
        const auto begin = std::ssize(arcs);
        for (const Index target : neighbours[cluster])
            if (std::ssize(arcs) > begin && arcs.back().target == target)
                arcs.back().length += 1.0;
            else
                arcs.push_back({target, 1.0});
    });
}

}  // namespace

FaceGraph make_face_graph(const PolygonMesh& mesh, const Topology& topology, const FaceClusters& clusters,
                          ArcMeasure measure, const Executor& exec)
{
    FaceGraph graph;
    std::vector<double> lengths;
    for (const BlockOfArcs& block : measure == ArcMeasure::Count
                                        ? list_arcs_by_count(mesh, topology, clusters, exec)
                                        : list_arcs_by_length(mesh, topology, clusters, exec)) {
        for (const Index count : block.counts)
            graph.offsets.push_back(graph.offsets.back() + count);
        for (const Arc& arc : block.arcs) {
            graph.targets.push_back(arc.target);
            lengths.push_back(arc.length);
        }
    }
    graph.arc_weights = arc_weights(lengths);
    const double total = mesh.n_corners();
    // Weights are at least 1 after rounding: the factor of 2 leaves room for that.
    const auto unit = std::max(Index{1}, static_cast<Index>(std::ceil(2 * total / max_weight_sum)));
    graph.node_weights.resize(graph.n_nodes());
    for_each(exec, graph.n_nodes(),
             [&](Index node) { graph.node_weights[node] = node_weight(mesh, clusters.faces[node], unit); });
    return graph;
}

Components graph_components(const FaceGraph& graph)
{
    return connected_components(graph.n_nodes(), [&](Index node, auto&& visit) {
        for (const Index neighbour : graph.neighbours(node))
            visit(neighbour);
    });
}

std::vector<FaceGraph> induced_subgraphs(const FaceGraph& graph, std::span<const Index> part_of, Index n_parts)
{
    std::vector<FaceGraph> parts(n_parts);
    std::vector<Index> node_in_part(part_of.size());
    for (std::size_t node = 0; node < part_of.size(); ++node) {
        auto& node_weights = parts[part_of[node]].node_weights;
        node_in_part[node] = static_cast<Index>(node_weights.size());
        node_weights.push_back(graph.node_weights[node]);
    }
    for (std::size_t node = 0; node < part_of.size(); ++node) {
        FaceGraph& part = parts[part_of[node]];
        for (Index arc = graph.offsets[node]; arc < graph.offsets[node + 1]; ++arc) {
            const auto target = usize(graph.targets[arc]);
            if (part_of[target] != part_of[node])
                continue;
            part.targets.push_back(node_in_part[target]);
            part.arc_weights.push_back(graph.arc_weights[arc]);
        }
        part.offsets.push_back(static_cast<Index>(part.targets.size()));
    }
    return parts;
}

}  // namespace seamflow
