#include "partition/cut/face_graph.h"

#include <algorithm>
#include <cmath>

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

std::vector<Index> node_weights(const PolygonMesh& mesh, std::span<const Index> faces)
{
    double total = 0;
    for (const Index f : faces)
        total += static_cast<double>(mesh.face(f).size());
    const auto divisor = static_cast<Index>(std::ceil(2 * total / max_weight_sum));
    std::vector<Index> weights(faces.size());
    std::transform(faces.begin(), faces.end(), weights.begin(), [&](Index f) {
        return std::max(Index{1}, (static_cast<Index>(mesh.face(f).size()) - 2) / std::max(divisor, Index{1}));
    });
    return weights;
}

}  // namespace

/// An arc before its length is turned into a whole number.
struct FaceGraphMaker::Arc {
    Index target;
    double length;
    /// By length too, so that parallel edges add up to the same bits from both sides.
    friend auto operator<=>(const Arc&, const Arc&) = default;
};

FaceGraphMaker::FaceGraphMaker(const PolygonMesh& mesh, const Topology& topology)
    : mesh_(mesh)
    , topology_(topology)
    , node_of_(at(mesh.n_faces()), -1)
{
}

/// The arcs of one face, ascending, with the lengths of parallel edges added up.
void FaceGraphMaker::collect_arcs(Index f, std::vector<Arc>& arcs) const
{
    arcs.clear();
    for (Index h = mesh_.face_offsets[at(f)]; h < mesh_.face_offsets[at(f) + 1]; ++h) {
        const Index twin = topology_.twin[at(h)];
        const Index target = twin < 0 ? -1 : node_of_[at(topology_.face_of[at(twin)])];
        if (target < 0)
            continue;
        arcs.push_back({target, edge_length(mesh_, topology_, h)});
    }
    std::sort(arcs.begin(), arcs.end());
    std::size_t n = 0;
    for (const Arc& arc : arcs)
        if (n > 0 && arcs[n - 1].target == arc.target)
            arcs[n - 1].length += arc.length;
        else
            arcs[n++] = arc;
    arcs.resize(n);
}

FaceGraph FaceGraphMaker::make(std::span<const Index> faces)
{
    for (std::size_t i = 0; i < faces.size(); ++i)
        node_of_[at(faces[i])] = static_cast<Index>(i);
    FaceGraph graph;
    std::vector<double> lengths;
    std::vector<Arc> arcs;
    for (const Index f : faces) {
        collect_arcs(f, arcs);
        for (const Arc& arc : arcs) {
            graph.targets.push_back(arc.target);
            lengths.push_back(arc.length);
        }
        graph.offsets.push_back(static_cast<Index>(graph.targets.size()));
    }
    graph.arc_weights = arc_weights(lengths);
    graph.node_weights = node_weights(mesh_, faces);
    for (const Index f : faces)
        node_of_[at(f)] = -1;
    return graph;
}

}  // namespace seamflow
