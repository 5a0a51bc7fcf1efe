#include "solvers/denoising/thinned_mesh.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "solvers/denoising/random_number.h"

namespace seamflow {

namespace {

/// A maximal set of vertices with faces, of which no two are neighbours.
/// @returns #V: 1 for vertices of the set.
std::vector<std::uint8_t> independent_set(const Topology& topology, const IndexLists& neighbours,
                                          const Points& positions, std::span<const int> n_chosen, std::uint64_t round)
{
    struct Candidate {
        int n_chosen;
        std::uint64_t number;
        Index vertex;
        auto operator<=>(const Candidate&) const = default;
    };
    std::vector<Candidate> candidates;
    for (Index v = 0; v < neighbours.size(); ++v)
        if (!topology.corners_at(v).empty())
            candidates.push_back({n_chosen[v], random_number_of(positions.row(v), round), v});
    std::ranges::sort(candidates);
    std::vector<std::uint8_t> is_chosen(n_chosen.size(), 0);
    for (const Candidate& candidate : candidates)
        is_chosen[candidate.vertex] =
            std::ranges::none_of(neighbours[candidate.vertex], [&](Index w) { return is_chosen[w] != 0; }) ? 1 : 0;
    return is_chosen;
}

}  // namespace

ThinnedMesh thin_out(const PolygonMesh& mesh, const Topology& topology, const IndexLists& neighbours,
                     const Points& positions, std::span<const int> n_chosen, std::uint64_t round)
{
    const std::vector<std::uint8_t> is_chosen = independent_set(topology, neighbours, positions, n_chosen, round);
    ThinnedMesh thinned;
    // Per vertex: the number in the thinned mesh of the kept vertex to which it belongs; -1 if there is none.
    std::vector<Index> number_of(is_chosen.size(), -1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (is_chosen[v] != 0) {
            number_of[v] = static_cast<Index>(thinned.vertices.size());
            thinned.vertices.push_back(v);
        }
    thinned.mesh.vertices = positions(thinned.vertices, Eigen::all);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Index w : is_chosen[v] == 0 ? neighbours[v] : std::span<const Index>())
            if (const double squared = (positions.row(v) - positions.row(w)).squaredNorm();
                is_chosen[w] != 0 && squared < nearest) {
                nearest = squared;
                number_of[v] = number_of[w];
            }
    }
    using Corners = std::array<Index, 3>;
    // The faces, with their corners in ascending order.
    std::vector<std::pair<Corners, Index>> faces;
    const auto corners_of = [&](Index f) {
        const auto face = mesh.face(f);
        return Corners{number_of[face[0]], number_of[face[1]], number_of[face[2]]};
    };
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        Corners corners = corners_of(f);
        std::ranges::sort(corners);
        if (corners[0] >= 0 && corners[0] != corners[1] && corners[1] != corners[2])
            faces.push_back({corners, f});
    }
    std::ranges::sort(faces);
    // Of several faces with the same corners, the first is kept.
    std::vector<Index> kept;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (i == 0 || faces[i].first != faces[i - 1].first)
            kept.push_back(faces[i].second);
    std::ranges::sort(kept);
    for (const Index f : kept)
        thinned.mesh.add_face(corners_of(f));
    thinned.topology = make_topology(thinned.mesh);
    free_boundary(thinned.topology);
    for (std::size_t i = 0; i < thinned.vertices.size(); ++i)
        if (const Index v = thinned.vertices[i]; !topology.moves(v) || thinned.topology.kind[i] != topology.kind[v])
            thinned.topology.fixed[i] = 1;
    return thinned;
}

}  // namespace seamflow
