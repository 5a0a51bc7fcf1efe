#include "solvers/rounding/joined_copies.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace seamflow {

namespace {

constexpr Index no_place = -1;

/// The vertices that are where others are.
struct SharedPlaces {
    /// #V: the number of the place of each vertex; no_place for vertices alone at theirs.
    std::vector<Index> place_of;
    /// The vertices at each place, ascending.
    IndexLists vertices;
};

SharedPlaces find_shared_places(const Topology& topology, const Points& positions, const Executor& exec)
{
    const auto n = static_cast<Index>(positions.rows());
    std::vector<Index> order = select(exec, n, [&](Index v) { return !topology.corners_at(v).empty(); });
    const auto place = [&](Index v) { return std::tuple(positions(v, 0), positions(v, 1), positions(v, 2)); };
    std::ranges::sort(order, {}, [&](Index v) { return std::tuple_cat(place(v), std::tuple(v)); });
    SharedPlaces shared{std::vector<Index>(usize(n), no_place), {}};
    for (auto first = order.begin(); first != order.end();) {
        const auto last = std::find_if(first, order.end(), [&](Index v) { return place(v) != place(*first); });
        if (last - first > 1) {
            for (const Index v : std::span(first, last)) {
                shared.place_of[v] = shared.vertices.size();
                shared.vertices.values.push_back(v);
            }
            shared.vertices.close();
        }
        first = last;
    }
    return shared;
}

/// An edge between two shared places, and the half-edge of a component there.
struct SharedEdge {
    std::array<Index, 2> places;
    Index component;
    Index halfedge;
};

/// #V: 1 for ends of edges that lie on edges of other components.
std::vector<std::uint8_t> ends_of_shared_edges(const PolygonMesh& mesh, const Topology& topology,
                                               const Components& components, const SharedPlaces& shared)
{
    const auto ends = [&](Index h) {
        return std::array{mesh.face_vertices[h], mesh.face_vertices[topology.next(mesh, h)]};
    };
    std::vector<SharedEdge> edges;
    for (Index h = 0; h < mesh.n_corners(); ++h) {
        const auto [v, w] = ends(h);
        const Index from = shared.place_of[v];
        const Index to = shared.place_of[w];
        if (from != no_place && to != no_place && from != to)
            edges.push_back(
                {{std::min(from, to), std::max(from, to)}, components.component_of[topology.face_of[h]], h});
    }
    std::ranges::sort(edges, {}, [](const SharedEdge& e) { return std::tuple(e.places, e.component, e.halfedge); });
    std::vector<std::uint8_t> found(usize(mesh.n_vertices()), 0);
    for (auto first = edges.begin(); first != edges.end();) {
        const auto last =
            std::find_if(first, edges.end(), [&](const SharedEdge& e) { return e.places != first->places; });
        if ((last - 1)->component != first->component)
            for (const SharedEdge& edge : std::span(first, last))
                for (const Index v : ends(edge.halfedge))
                    found[v] = 1;
        first = last;
    }
    return found;
}

/// Leaves out faces with the same vertices as an earlier one.
PolygonMesh without_repeated_faces(const PolygonMesh& mesh)
{
    std::vector<std::pair<std::vector<Index>, Index>> sorted(usize(mesh.n_faces()));
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        sorted[f] = {{mesh.face(f).begin(), mesh.face(f).end()}, f};
        std::ranges::sort(sorted[f].first);
    }
    std::ranges::sort(sorted);
    std::vector<std::uint8_t> is_repeated(usize(mesh.n_faces()), 0);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        is_repeated[sorted[i].second] = sorted[i].first == sorted[i - 1].first ? 1 : 0;
    PolygonMesh kept;
    kept.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (is_repeated[f] == 0)
            kept.add_face(mesh.face(f));
    return kept;
}

}  // namespace

std::vector<std::uint8_t> JoinedCopies::shared_vertices() const
{
    std::vector<std::uint8_t> is_shared(original_of.size(), 0);
    for (std::size_t v = 0; v < original_of.size(); ++v)
        if (const Index original = original_of[v]; original != static_cast<Index>(v))
            is_shared[v] = is_shared[usize(original)] = 1;
    for (const Index v : ambiguous)
        is_shared[usize(v)] = 1;
    return is_shared;
}

std::optional<JoinedCopies> join_copies(const PolygonMesh& mesh, const Topology& topology, const Components& components,
                                        const Points& positions, const Executor& exec)
{
    if (components.count() < 2)
        return std::nullopt;
    const SharedPlaces shared = find_shared_places(topology, positions, exec);
    if (shared.vertices.size() == 0)
        return std::nullopt;
    const std::vector<std::uint8_t> is_end = ends_of_shared_edges(mesh, topology, components, shared);
    JoinedCopies joined;
    joined.original_of.resize(usize(mesh.n_vertices()));
    std::iota(joined.original_of.begin(), joined.original_of.end(), Index{0});
    bool has_copies = false;
    for (Index place = 0; place < shared.vertices.size(); ++place) {
        std::vector<Index> copies;
        std::ranges::copy_if(shared.vertices[place], std::back_inserter(copies),
                             [&](Index v) { return is_end[v] != 0; });
        std::vector<Index> of_copies;
        for (const Index v : copies)
            of_copies.push_back(components.component_of[topology.face_of[topology.corners_at(v).front()]]);
        sort_unique(of_copies);
        if (copies.size() < 2)
            continue;
        if (of_copies.size() < copies.size()) {
            joined.ambiguous.insert(joined.ambiguous.end(), copies.begin(), copies.end());
            continue;
        }
        has_copies = true;
        for (const Index v : copies)
            joined.original_of[v] = copies.front();
    }
    if (!has_copies && joined.ambiguous.empty())
        return std::nullopt;
    std::ranges::sort(joined.ambiguous);
    joined.all_faces = {positions, mesh.face_offsets, mesh.face_vertices};
    for (Index& v : joined.all_faces.face_vertices)
        v = joined.original_of[v];
    joined.mesh = without_repeated_faces(joined.all_faces);
    return joined;
}

}  // namespace seamflow
