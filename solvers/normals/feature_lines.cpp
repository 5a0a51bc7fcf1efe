#include "solvers/normals/feature_lines.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

Edge edge_between(Index v, Index w)
{
    return {std::min(v, w), std::max(v, w)};
}

/// The vertices at both ends of a half-edge.
Edge edge_of(const PolygonMesh& mesh, const Topology& topology, Index h)
{
    return edge_between(mesh.face_vertices[h], mesh.face_vertices[topology.next(mesh, h)]);
}

/// Whether a face has an edge between two vertices, which need not exist.
bool is_edge(const PolygonMesh& mesh, const Topology& topology, const Edge& edge)
{
    if (edge[0] < 0 || edge[1] >= mesh.n_vertices())
        return false;
    return std::ranges::any_of(topology.corners_at(edge[0]), [&](Index corner) {
        return mesh.face_vertices[topology.next(mesh, corner)] == edge[1] ||
               mesh.face_vertices[topology.previous(mesh, corner)] == edge[1];
    });
}

/// The point of a segment that is nearest to p.
Point nearest_on(const Point& from, const Point& to, const Point& p)
{
    const Point along = to - from;
    const double squared = along.squaredNorm();
    if (!(squared > 0.0))
        return from;
    return from + std::clamp((p - from).dot(along) / squared, 0.0, 1.0) * along;
}

}  // namespace

FeatureLines::FeatureLines(const PolygonMesh& mesh, const Topology& topology, std::span<const Edge> edges)
{
    if (edges.empty())
        return;
    for (const auto& [v, w] : edges) {
        edges_.push_back(edge_between(v, w));
        if (!is_edge(mesh, topology, edges_.back()))
            throw InputError(
                fmt::format("the vertices {} and {} (numbered from 0) of a feature edge share no edge of a "
                            "face: give pairs that do",
                            v, w));
    }
    sort_unique(edges_);
    line_vertex_of_.assign(usize(mesh.n_vertices()), -1);
    std::vector<std::vector<Index>> ends;
    for (const auto& [v, w] : edges_)
        for (const auto& [here, there] : {std::pair(v, w), std::pair(w, v)}) {
            if (line_vertex_of_[here] < 0) {
                line_vertex_of_[here] = static_cast<Index>(ends.size());
                ends.emplace_back();
                const Point position = mesh.vertices.row(here);
                line_vertices_.push_back({position, position, position});
            }
            ends[line_vertex_of_[here]].push_back(there);
        }
    for (std::size_t i = 0; i < line_vertices_.size(); ++i) {
        LineVertex& vertex = line_vertices_[i];
        const auto middle = [&](std::size_t k) -> Point { return 0.5 * (vertex.here + mesh.vertices.row(ends[i][k])); };
        if (ends[i].size() != 2)
            continue;
        vertex.before = middle(0);
        vertex.after = middle(1);
    }
}

PolygonMesh FeatureLines::cut_open(const PolygonMesh& mesh, const Topology& topology) const
{
    PolygonMesh open;
    open.face_offsets = mesh.face_offsets;
    open.face_vertices = mesh.face_vertices;
    Index n = mesh.n_vertices();
    const auto is_kept = [&](Index h) { return std::ranges::binary_search(edges_, edge_of(mesh, topology, h)); };
    std::vector<char> is_known(mesh.face_vertices.size());
    std::vector<Index> waiting;
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        if (line_vertex_of_[v] < 0)
            continue;
        bool is_first = true;
        for (const Index start : topology.corners_at(v)) {
            if (is_known[start] != 0)
                continue;
            // All corners reached from here without crossing a line get the same vertex.
            const Index number = is_first ? v : n++;
            is_first = false;
            is_known[start] = 1;
            waiting.assign(1, start);
            while (!waiting.empty()) {
                const Index corner = waiting.back();
                waiting.pop_back();
                open.face_vertices[corner] = number;
                for (const Index h : {corner, topology.previous(mesh, corner)}) {
                    const Index twin = topology.twin[h];
                    if (twin < 0 || is_kept(h))
                        continue;
                    const Index across = mesh.face_vertices[twin] == v ? twin : topology.next(mesh, twin);
                    if (is_known[across] == 0) {
                        is_known[across] = 1;
                        waiting.push_back(across);
                    }
                }
            }
        }
    }
    open.vertices = Points::Zero(n, 3);
    return open;
}

Point FeatureLines::on_line(Index v, const Point& p) const
{
    if (line_vertex_of_.empty() || line_vertex_of_[v] < 0)
        return p;
    const LineVertex& vertex = line_vertices_[line_vertex_of_[v]];
    const Point before = nearest_on(vertex.here, vertex.before, p);
    const Point after = nearest_on(vertex.here, vertex.after, p);
    return (before - p).squaredNorm() < (after - p).squaredNorm() ? before : after;
}

}  // namespace seamflow
