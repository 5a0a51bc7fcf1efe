#include "partition/cut/face_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "partition/index.h"

namespace seamflow {

namespace {

constexpr double mean_arc_weight = 64;

double edge_length(const PolygonMesh& mesh, const Topology& topology, Index h)
{
    const Index from = mesh.face_vertices[at(h)];
    const Index to = mesh.face_vertices[at(topology.next(mesh, h))];
    // From the lower to the higher vertex, so that both half-edges of an edge give the same bits.
    return (mesh.vertices.row(std::max(from, to)) - mesh.vertices.row(std::min(from, to))).norm();
}

/// Whole numbers in proportion to the lengths, each at least 1, that add up to no more than max_weight_sum.
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

/// An arc before its length is turned into a whole number.
struct Arc {
    Index target;
    double length;
    /// By length too, so that shared edges add up to the same bits from both sides.
    friend auto operator<=>(const Arc&, const Arc&) = default;
};

/// Of a cluster's arcs so far, how many are looked through for one that an edge belongs to: clusters have about six
/// neighbours.
constexpr std::ptrdiff_t most_looked_through = 8;

/// Adds an edge to one of the latest arcs, or as a new one; later ones may have the same target. Numbers of edges add
/// up to the same bits in any order.
void count_edge(Index target, std::ptrdiff_t begin, std::vector<Arc>& arcs)
{
    const auto first = arcs.begin() + std::max(begin, std::ssize(arcs) - most_looked_through);
    const auto arc = std::find_if(first, arcs.end(), [&](const Arc& a) { return a.target == target; });
    if (arc != arcs.end())
        arc->length += 1.0;
    else
        arcs.push_back({target, 1.0});
}

/// Appends the arcs of a cluster, ascending, with the lengths of all edges shared with the same other cluster added up.
void append_arcs(const PolygonMesh& mesh, const Topology& topology, const FaceClusters& clusters, ArcMeasure measure,
                 Index cluster, std::vector<Arc>& arcs)
{
    const auto begin = static_cast<std::ptrdiff_t>(arcs.size());
    for (const Index f : clusters.faces[cluster])
        for (Index h = mesh.face_offsets[at(f)]; h < mesh.face_offsets[at(f) + 1]; ++h) {
            const Index twin = topology.twin[at(h)];
            const Index target = twin < 0 ? cluster : clusters.cluster_of[at(topology.face_of[at(twin)])];
            if (target == cluster)
                continue;
            if (measure == ArcMeasure::Count)
                count_edge(target, begin, arcs);
            else
                arcs.push_back({target, edge_length(mesh, topology, h)});
        }
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

/// The arcs of one block of nodes, and how many each node has.
struct BlockOfArcs {
    std::vector<Arc> arcs;
    std::vector<Index> counts;
};

std::vector<BlockOfArcs> list_arcs(const PolygonMesh& mesh, const Topology& topology, const FaceClusters& clusters,
                                   ArcMeasure measure, const Loop& loop)
{
    std::vector<BlockOfArcs> blocks(at(clusters.size() / block_size) + 1);
    for_each_block(loop, clusters.size(), [&](Index b, Index begin, Index end) {
        BlockOfArcs& block = blocks[at(b)];
        for (Index cluster = begin; cluster < end; ++cluster) {
            const std::size_t before = block.arcs.size();
            append_arcs(mesh, topology, clusters, measure, cluster, block.arcs);
            block.counts.push_back(static_cast<Index>(block.arcs.size() - before));
        }
    });
    return blocks;
}

}  // namespace

FaceGraph make_face_graph(const PolygonMesh& mesh, const Topology& topology, const FaceClusters& clusters,
                          ArcMeasure measure, const Loop& loop)
{
    FaceGraph graph;
    std::vector<double> lengths;
    for (const BlockOfArcs& block : list_arcs(mesh, topology, clusters, measure, loop)) {
        for (const Index count : block.counts)
            graph.offsets.push_back(graph.offsets.back() + count);
        for (const Arc& arc : block.arcs) {
            graph.targets.push_back(arc.target);
            lengths.push_back(arc.length);
        }
    }
    graph.arc_weights = arc_weights(lengths);
    const double total = mesh.n_corners();
    const auto unit = std::max(Index{1}, static_cast<Index>(std::ceil(2 * total / max_weight_sum)));
    graph.node_weights.resize(at(graph.n_nodes()));
    for_each(loop, graph.n_nodes(),
             [&](Index node) { graph.node_weights[at(node)] = node_weight(mesh, clusters.faces[node], unit); });
    return graph;
}

GraphComponents graph_components(const FaceGraph& graph)
{
    GraphComponents components;
    components.component_of.assign(at(graph.n_nodes()), -1);
    std::vector<Index> reached;
    const auto reach = [&](Index node) {
        if (components.component_of[at(node)] >= 0)
            return;
        components.component_of[at(node)] = components.count;
        reached.push_back(node);
    };
    for (Index lowest = 0; lowest < graph.n_nodes(); ++lowest) {
        if (components.component_of[at(lowest)] >= 0)
            continue;
        for (reach(lowest); !reached.empty();) {
            const Index node = reached.back();
            reached.pop_back();
            for (Index arc = graph.offsets[at(node)]; arc < graph.offsets[at(node) + 1]; ++arc)
                reach(graph.targets[at(arc)]);
        }
        ++components.count;
    }
    return components;
}

std::vector<FaceGraph> take_apart(const FaceGraph& graph, std::span<const Index> part_of, Index n_parts)
{
    std::vector<FaceGraph> parts(at(n_parts));
    std::vector<Index> node_in_part(part_of.size());
    for (std::size_t node = 0; node < part_of.size(); ++node) {
        auto& node_weights = parts[at(part_of[node])].node_weights;
        node_in_part[node] = static_cast<Index>(node_weights.size());
        node_weights.push_back(graph.node_weights[node]);
    }
    for (std::size_t node = 0; node < part_of.size(); ++node) {
        FaceGraph& part = parts[at(part_of[node])];
        for (Index arc = graph.offsets[node]; arc < graph.offsets[node + 1]; ++arc) {
            const auto target = at(graph.targets[at(arc)]);
            if (part_of[target] != part_of[node])
                continue;
            part.targets.push_back(node_in_part[target]);
            part.arc_weights.push_back(graph.arc_weights[at(arc)]);
        }
        part.offsets.push_back(static_cast<Index>(part.targets.size()));
    }
    return parts;
}

}  // namespace seamflow
