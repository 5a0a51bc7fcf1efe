#include "partition/topology.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/index_lists.h"
#include "partition/large_arrays.h"

namespace seamflow {

namespace {

/// In `twin`, until the vertices are classified: marks an edge of three or more faces.
constexpr Index non_manifold_edge = -2;

/// Lists the corners at each vertex: Topology::vertex_offsets and vertex_corners.
void list_corners(const PolygonMesh& mesh, Topology& topology)
{
    IndexLists corners = make_lists(mesh.n_vertices(), [&](auto&& add) {
        for (Index h = 0; h < mesh.n_corners(); ++h)
            add(mesh.face_vertices[h], h);
    });
    topology.vertex_offsets = std::move(corners.offsets);
    topology.vertex_corners = std::move(corners.values);
}

/// A half-edge at a vertex, with the vertex at its other end.
struct Spoke {
    Index neighbour;
    Index halfedge;
    friend auto operator<=>(const Spoke&, const Spoke&) = default;
};

/// Lists the half-edges between v and vertices of an index higher than `lowest`, in ascending order.
void list_spokes(const PolygonMesh& mesh, const Topology& topology, Index v, Index lowest, std::vector<Spoke>& spokes)
{
    spokes.clear();
    for (const Index h : topology.corners_at(v))
        for (const auto& [neighbour_corner, halfedge] :
             {std::pair(topology.next(mesh, h), h), std::pair(topology.previous(mesh, h), topology.previous(mesh, h))})
            if (const Index neighbour = mesh.face_vertices[neighbour_corner]; neighbour > lowest)
                spokes.push_back({neighbour, halfedge});
    std::sort(spokes.begin(), spokes.end());
}

/// Calls action with the spokes of each edge at the vertex.
template <class Action>
void for_each_edge(std::span<const Spoke> spokes, Action&& action)
{
    for (auto first = spokes.begin(); first != spokes.end();) {
        const auto last =
            std::find_if(first, spokes.end(), [&](const Spoke& s) { return s.neighbour != first->neighbour; });
        action(std::span(first, last));
        first = last;
    }
}

/// Pairs the half-edges between v and vertices of higher index.
/// @returns whether the two half-edges of every pair run in opposite directions.
bool pair_halfedges_at(const PolygonMesh& mesh, Index v, std::vector<Spoke>& spokes, Topology& topology)
{
    bool opposite = true;
    list_spokes(mesh, topology, v, v, spokes);
    for_each_edge(spokes, [&](std::span<const Spoke> edge) {
        if (edge.size() == 2) {
            topology.twin[edge[0].halfedge] = edge[1].halfedge;
            topology.twin[edge[1].halfedge] = edge[0].halfedge;
            opposite &= mesh.face_vertices[edge[0].halfedge] != mesh.face_vertices[edge[1].halfedge];
        } else if (edge.size() > 2) {
            for (const Spoke& spoke : edge)
                topology.twin[spoke.halfedge] = non_manifold_edge;
        }
    });
    return opposite;
}

/// The two half-edges at the vertex of a corner, in its face.
std::array<Index, 2> spokes_of(const PolygonMesh& mesh, const Topology& topology, Index corner)
{
    return {corner, topology.previous(mesh, corner)};
}

/// The corner at v of the face of half-edge h, which begins or ends at v.
Index corner_at(const PolygonMesh& mesh, const Topology& topology, Index h, Index v)
{
    return mesh.face_vertices[h] == v ? h : topology.next(mesh, h);
}

/// The end of half-edge h that is not v.
Index other_end(const PolygonMesh& mesh, const Topology& topology, Index h, Index v)
{
    const Index start = mesh.face_vertices[h];
    return start == v ? mesh.face_vertices[topology.next(mesh, h)] : start;
}

/// Walks from corner `start` across its half-edge `spoke` and on, face by face, as long as the faces belong to the fan.
/// @returns the last half-edge reached; `visit` gets each further corner.
template <class Belongs, class Visit>
Index walk(const PolygonMesh& mesh, const Topology& topology, Index v, Index start, Index spoke, Belongs&& belongs,
           Visit&& visit)
{
    for (;;) {
        const Index across = topology.twin[spoke];
        if (across < 0 || !belongs(topology.face_of[across]))
            return spoke;
        const Index next_corner = corner_at(mesh, topology, across, v);
        if (next_corner == start)
            return spoke;
        visit(next_corner);
        const auto spokes = spokes_of(mesh, topology, next_corner);
        spoke = spokes[0] == across ? spokes[1] : spokes[0];
    }
}

/// Whether a walk around a vertex visits all of its faces and returns to the first.
bool is_closed_fan(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    const auto corners = topology.corners_at(v);
    std::size_t met = 1;
    const Index last = walk(
        mesh, topology, v, corners.front(), corners.front(), [](Index) { return true; }, [&](Index) { ++met; });
    return met == corners.size() && topology.twin[last] >= 0;
}

/// The kind of vertex v. Edges of three or more faces must still be marked in `twin` (see non_manifold_edge).
VertexKind classify(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    const auto corners = topology.corners_at(v);
    if (corners.empty())
        return VertexKind::Isolated;
    if (is_closed_fan(mesh, topology, v))
        return VertexKind::Interior;
    Index lowest = 0;
    for (const Index corner : corners)
        for (const Index spoke : spokes_of(mesh, topology, corner))
            lowest = std::min(lowest, topology.twin[spoke]);
    return lowest == -1 ? VertexKind::Boundary : VertexKind::NonManifold;
}

/// The number of corners of every face; 0 if the numbers differ, or if there are no faces.
Index common_degree(const PolygonMesh& mesh)
{
    if (mesh.n_faces() == 0)
        return 0;
    const Index degree = mesh.face_offsets[1];
    for (Index f = 1; f < mesh.n_faces(); ++f)
        if (mesh.face_offsets[f + 1] - mesh.face_offsets[f] != degree)
            return 0;
    return degree;
}

}  // namespace

FaceOfHalfedge::FaceOfHalfedge(const PolygonMesh& mesh, const Executor& exec)
    : degree_(common_degree(mesh))
{
    if (degree_ > 0) {
        // The multiplier exceeds 2^shift / degree by 1 at most: for half-edges, which are less than 2^31, this adds
        // less than 1 / degree to the quotient. The product stays below 2^64.
        shift_ = 31 + static_cast<int>(std::bit_width(static_cast<std::uint32_t>(degree_ - 1)));
        multiplier_ = (std::uint64_t{1} << shift_) / static_cast<std::uint64_t>(degree_) + 1;
        return;
    }
    faces_ = large_vector<Index>(mesh.face_vertices.size());
    for_each(exec, mesh.n_faces(), [&](Index f) {
        std::fill(faces_.begin() + mesh.face_offsets[f], faces_.begin() + mesh.face_offsets[f + 1], f);
    });
}

Topology make_topology(const PolygonMesh& mesh, const Executor& exec)
{
    Topology topology;
    topology.face_of = FaceOfHalfedge(mesh, exec);
    // Two independent tasks, at the same time if the executor has several threads.
    for_each(exec, 2, [&](Index one_of_both) {
        if (one_of_both == 0)
            list_corners(mesh, topology);
        else
            topology.twin = large_vector<Index>(mesh.face_vertices.size(), -1);
    });
    std::atomic<bool> oriented = true;
    exec(mesh.n_vertices(), [&](Index begin, Index end) {
        std::vector<Spoke> spokes;
        bool opposite = true;
        for (Index v = begin; v < end; ++v)
            opposite &= pair_halfedges_at(mesh, v, spokes, topology);
        if (!opposite)
            oriented = false;
    });
    topology.oriented = oriented;
    topology.kind.resize(mesh.n_vertices());
    topology.fixed.resize(mesh.n_vertices());
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        topology.kind[v] = classify(mesh, topology, v);
        topology.fixed[v] = topology.kind[v] == VertexKind::Interior ? 0 : 1;
    });
    for_each(exec, mesh.n_corners(), [&](Index h) { topology.twin[h] = std::max(topology.twin[h], -1); });
    return topology;
}

void free_boundary(Topology& topology)
{
    for (std::size_t v = 0; v < topology.kind.size(); ++v)
        if (topology.kind[v] == VertexKind::Boundary)
            topology.fixed[v] = 0;
}

Index Topology::junction_index(Index h) const
{
    const auto found = std::ranges::lower_bound(junctions, h, {}, &JunctionLink::halfedge);
    return found != junctions.end() && found->halfedge == h ? static_cast<Index>(found - junctions.begin()) : -1;
}

Index Topology::next_at_junction(Index h) const
{
    const Index index = junction_index(h);
    return index < 0 ? h : junctions[index].next;
}

void free_junctions(const PolygonMesh& mesh, Topology& topology, const Executor& exec)
{
    std::vector<Spoke> spokes;
    for (const Index v :
         select(exec, mesh.n_vertices(), [&](Index v) { return topology.kind[v] == VertexKind::NonManifold; })) {
        bool is_at_junction = false;
        bool is_on_boundary = false;
        list_spokes(mesh, topology, v, -1, spokes);
        for_each_edge(spokes, [&](std::span<const Spoke> edge) {
            is_at_junction |= edge.size() > 2;
            is_on_boundary |= edge.size() == 1;
            const std::size_t n = edge.size();
            // Every edge has two ends: the links are added at the lower one.
            for (std::size_t i = 0; n > 2 && edge[0].neighbour > v && i < n; ++i)
                topology.junctions.push_back({edge[i].halfedge, edge[(i + 1) % n].halfedge,
                                              edge[(i + n - 1) % n].halfedge, static_cast<Index>(n)});
        });
        if (!is_at_junction)
            continue;
        topology.kind[v] = is_on_boundary ? VertexKind::Boundary : VertexKind::Junction;
        topology.fixed[v] = is_on_boundary ? 1 : 0;
    }
    std::ranges::sort(topology.junctions, {}, &JunctionLink::halfedge);
}

void edge_neighbours(const PolygonMesh& mesh, const Topology& topology, Index v, std::vector<Index>& neighbours)
{
    neighbours.clear();
    for (const Index corner : topology.corners_at(v)) {
        neighbours.push_back(mesh.face_vertices[topology.next(mesh, corner)]);
        neighbours.push_back(mesh.face_vertices[topology.previous(mesh, corner)]);
    }
    sort_unique(neighbours);
}

std::vector<Index> neighbours_of(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    std::vector<Index> neighbours;
    edge_neighbours(mesh, topology, v, neighbours);
    std::erase(neighbours, v);
    return neighbours;
}

void fix_vertices(Topology& topology, std::span<const Index> vertices)
{
    const auto n_vertices = static_cast<Index>(topology.fixed.size());
    for (const Index v : vertices) {
        if (v < 0 || v >= n_vertices)
            throw InputError(fmt::format("vertex {} is to be held fixed, but the mesh has {} vertices, numbered from 0",
                                         v, n_vertices));
        topology.fixed[v] = 1;
    }
}

std::pair<Index, Index> ends_of_fan(const PolygonMesh& mesh, const Topology& topology, Index start,
                                    std::span<const Index> labels)
{
    const Index v = mesh.face_vertices[start];
    const auto belongs = [&](Index f) { return labels[f] == labels[topology.face_of[start]]; };
    const auto end_across = [&](Index spoke) {
        return other_end(mesh, topology, walk(mesh, topology, v, start, spoke, belongs, [](Index) {}), v);
    };
    const auto spokes = spokes_of(mesh, topology, start);
    return {end_across(spokes[1]), end_across(spokes[0])};
}

std::vector<Fan> fans_at(const PolygonMesh& mesh, const Topology& topology, Index v, std::span<const Index> labels,
                         Index label)
{
    const auto belongs = [&](Index f) { return labels.empty() || labels[f] == label; };
    const auto corners = topology.corners_at(v);
    std::vector<bool> visited(corners.size(), false);
    const auto mark = [&](Index corner) { visited[usize(place_in(corners, corner))] = true; };

    std::vector<Fan> fans;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (visited[i] || !belongs(topology.face_of[corners[i]]))
            continue;
        Fan fan;
        const auto spokes = spokes_of(mesh, topology, corners[i]);
        const auto append = [&](Index corner) {
            mark(corner);
            fan.corners.push_back(corner);
        };
        append(corners[i]);
        const Index last = walk(mesh, topology, v, corners[i], spokes[0], belongs, append);
        fan.closed = topology.twin[last] >= 0 && topology.twin[last] == spokes[1];
        Index first = spokes[1];
        if (!fan.closed) {
            const auto n_forwards = std::ssize(fan.corners);
            first = walk(mesh, topology, v, corners[i], spokes[1], belongs, append);
            // The corners of the second walk, reversed, precede those of the first.
            std::reverse(fan.corners.begin() + n_forwards, fan.corners.end());
            std::rotate(fan.corners.begin(), fan.corners.begin() + n_forwards, fan.corners.end());
        }
        fan.first = other_end(mesh, topology, first, v);
        fan.last = other_end(mesh, topology, last, v);
        fans.push_back(std::move(fan));
    }
    return fans;
}

}  // namespace seamflow
