#include "partition/inspection/mesh_inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "partition/connected_components.h"
#include "partition/index_lists.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/edge_measures.h"
#include "partition/point_numbers.h"
#include "partition/repeated_faces.h"
#include "partition/vector_area.h"
#include "partition/weld.h"
#include "partition/with_faces.h"

namespace seamflow {

namespace {

/// A mesh and its connectivity.
struct Surface {
    const PolygonMesh& mesh;
    const Topology& topology;

    [[nodiscard]] Index start(Index h) const { return mesh.face_vertices[h]; }
    [[nodiscard]] Index end(Index h) const { return mesh.face_vertices[topology.next(mesh, h)]; }
    [[nodiscard]] Edge edge(Index h) const { return {std::min(start(h), end(h)), std::max(start(h), end(h))}; }
    /// Whether both ends of a half-edge have finite positions.
    [[nodiscard]] bool is_finite(Index h) const
    {
        return mesh.vertices.row(start(h)).allFinite() && mesh.vertices.row(end(h)).allFinite();
    }
    [[nodiscard]] double length(Index h) const { return edge_length(mesh, topology, h); }
};

/// The edges of the half-edges for which `holds` is true, each once, ascending.
template <class Predicate>
std::vector<Edge> edges_where(const Surface& s, const Executor& exec, Predicate&& holds)
{
    std::vector<Edge> edges;
    for (const Index h : select(exec, s.mesh.n_corners(), holds))
        edges.push_back(s.edge(h));
    sort_unique(edges);
    return edges;
}

/// Counts the edges and lists the faulty ones. A half-edge without a twin is on an edge of one face, or of three or
/// more.
void inspect_edges(const Surface& s, const Executor& exec, MeshInspection& found)
{
    const auto alone = select(exec, s.mesh.n_corners(), [&](Index h) { return s.topology.twin[h] < 0; });
    std::vector<Edge> edges;
    for (const Index h : alone)
        edges.push_back(s.edge(h));
    std::sort(edges.begin(), edges.end());
    found.counts.edges = (s.mesh.n_corners() - static_cast<Index>(alone.size())) / 2;
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last = std::find_if(first, edges.end(), [&](const Edge& e) { return e != *first; });
        ++found.counts.edges;
        if (last - first == 1)
            ++found.counts.boundary_edges;
        else
            found.defects.non_manifold_edges.push_back(*first);
        first = last;
    }
    found.defects.inconsistent_edges = edges_where(s, exec, [&](Index h) {
        const Index twin = s.topology.twin[h];
        return twin > h && s.start(h) == s.start(twin);
    });
    found.defects.edges_without_length =
        edges_where(s, exec, [&](Index h) { return s.is_finite(h) && !std::isnormal(s.length(h)); });
}

/// The lengths of the edges whose ends have finite positions; zeros if there are none.
EdgeLengths measure_edges(const Surface& s)
{
    EdgeLengths found{.shortest = std::numeric_limits<double>::infinity()};
    double sum = 0.0;
    Index count = 0;
    for (Index h = 0; h < s.mesh.n_corners(); ++h) {
        if (!s.is_finite(h))
            continue;
        const double length = s.length(h);
        sum += length;
        ++count;
        found.shortest = std::min(found.shortest, length);
        found.longest = std::max(found.longest, length);
    }
    if (count == 0)
        return {};
    found.mean = sum / static_cast<double>(count);
    return found;
}

/// Sets `box` and `bits_for_detail`.
/// @param found with edge lengths.
void measure_box(const BoundingBox& box, MeshInspection& found)
{
    const auto& [low, high] = box;
    const Point middle = low + (high - low) / 2.0;
    found.box.middle = {middle[0], middle[1], middle[2]};
    found.box.diagonal = box.diagonal();
    const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    if (std::isnormal(found.edge_lengths.mean) && farthest > found.edge_lengths.mean)
        found.bits_for_detail = std::max(0, 53 - (std::ilogb(farthest) - std::ilogb(found.edge_lengths.mean)));
}

/// Whether a face has no area, although its positions are finite.
bool lacks_area(const PolygonMesh& mesh, Index f)
{
    const auto is_finite = [&](Index v) { return mesh.vertices.row(v).allFinite(); };
    return !has_area(mesh.face(f), mesh.vertices) && std::ranges::all_of(mesh.face(f), is_finite);
}

/// The vertices with the same position as an earlier vertex, ascending.
std::vector<Index> coincident_vertices(const Points& positions, const Executor& exec)
{
    std::vector<PointNumbers::Place> places;
    places.reserve(static_cast<std::size_t>(positions.rows()));
    for (const auto& row : positions.rowwise())
        places.push_back({row[0], row[1], row[2]});
    const std::vector<Index> first = PointNumbers::first_equal(places);
    return select(exec, static_cast<Index>(first.size()), [&](Index v) { return first[v] != v; });
}

/// Whether two faces with the same vertices run around them in opposite senses.
bool run_opposite(std::span<const Index> face, std::span<const Index> other)
{
    const auto begin = static_cast<std::size_t>(std::ranges::find(other, face.front()) - other.begin());
    return other[(begin + 1) % other.size()] != face[1];
}

/// Lists the faces that are duplicates. Counts the components, and lists the pairs of faces that cross, of the mesh
/// without duplicates.
void inspect_duplicates(const Surface& s, const Executor& exec, MeshInspection& found)
{
    std::vector<Index> faces(s.mesh.n_faces());
    std::iota(faces.begin(), faces.end(), 0);
    const std::vector<RepeatedFace> repeated = find_repeated_faces(s.mesh, faces);
    for (const auto& [face, first] : repeated) {
        found.defects.duplicate_faces.push_back(face);
        found.defects.n_turned_round += run_opposite(s.mesh.face(face), s.mesh.face(first)) ? 1 : 0;
    }
    if (repeated.empty()) {
        found.counts.components = face_components(s.mesh, s.topology).count();
        found.defects.self_intersections = self_intersections(s.mesh, s.mesh.vertices, exec);
        return;
    }
    const PolygonMesh single = with_single_faces(s.mesh, found);
    found.counts.components = face_components(single, make_topology(single, exec)).count();
    faces.clear();
    for (Index f = 0; f < s.mesh.n_faces(); ++f)
        if (!std::ranges::binary_search(found.defects.duplicate_faces, f))
            faces.push_back(f);
    for (const FacePair& pair : self_intersections(single, single.vertices, exec))
        found.defects.self_intersections.push_back({faces[pair[0]], faces[pair[1]]});
}

/// Orients the faces one after the other, consistently with the faces before. Returns whether all are consistent.
bool is_orientable(const Surface& s)
{
    std::vector<signed char> sense(s.mesh.n_faces(), 0);
    std::vector<Index> reached;
    bool all_fit = true;
    for (Index root = 0; root < s.mesh.n_faces() && all_fit; ++root) {
        if (sense[root] != 0)
            continue;
        sense[root] = 1;
        reached.clear();
        append_reachable(root, reached, [&](Index f, auto&& reach) {
            for_each_neighbour(s.mesh, s.topology, f, [&](Index h, Index other) {
                const bool runs_back = s.start(h) != s.start(s.topology.twin[h]);
                const auto fitting = static_cast<signed char>(runs_back ? sense[f] : -sense[f]);
                if (sense[other] == 0) {
                    sense[other] = fitting;
                    reach(other);
                } else if (sense[other] != fitting) {
                    all_fit = false;
                }
            });
        });
    }
    return all_fit;
}

}  // namespace

MeshInspection inspect(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const Surface surface{mesh, topology};
    MeshInspection found;
    found.counts.vertices = mesh.n_vertices();
    found.counts.faces = mesh.n_faces();
    for (Index f = 0; f < mesh.n_faces(); ++f)
        ++found.counts.faces_by_sides[std::min(mesh.face(f).size() - 3, found.counts.faces_by_sides.size() - 1)];
    inspect_edges(surface, exec, found);
    if (const std::optional<Weld> welded = weld(mesh, topology, 0.0, exec)) {
        found.counts.seam_edges = welded->n_edges;
        found.counts.seam_vertices = welded->n_vertices;
        found.cracks = find_cracks(welded->mesh, welded->topology, exec);
    } else {
        found.cracks = find_cracks(mesh, topology, exec);
    }
    found.edge_lengths = measure_edges(surface);
    const BoundingBox box = box_of_faces(mesh, exec);
    measure_box(box, found);
    found.defects.vertices_not_finite =
        select(exec, mesh.n_vertices(), [&](Index v) { return !mesh.vertices.row(v).allFinite(); });
    const auto of_kind = [&](VertexKind kind) {
        return select(exec, mesh.n_vertices(), [&](Index v) { return topology.kind[v] == kind; });
    };
    found.defects.non_manifold_vertices = of_kind(VertexKind::NonManifold);
    found.defects.isolated_vertices = of_kind(VertexKind::Isolated);
    found.defects.far_vertices = far_from_faces(box, mesh.vertices, found.defects.isolated_vertices);
    found.orientable = is_orientable(surface);
    inspect_duplicates(surface, exec, found);
    for (const Spike& spike : find_spikes(mesh, mesh.vertices, exec))
        found.defects.spikes.push_back(spike.vertex);
    found.defects.faces_without_area = select(exec, mesh.n_faces(), [&](Index f) { return lacks_area(mesh, f); });
    found.defects.coincident_vertices = coincident_vertices(mesh.vertices, exec);
    return found;
}

PolygonMesh with_single_faces(const PolygonMesh& mesh, const MeshInspection& found)
{
    return with_faces(mesh, [&](Index f) { return !std::ranges::binary_search(found.defects.duplicate_faces, f); });
}

}  // namespace seamflow
