#include "partition/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "partition/disjoint_sets.h"
#include "partition/index_lists.h"
#include "partition/point_numbers.h"

namespace seamflow {

namespace {

/// Calls `visit` for half of the cells around a cell: for each pair of neighbouring cells, from one of the two.
template <class Visit>
void for_half_of_neighbours(const PointNumbers::Place& cell, Visit&& visit)
{
    constexpr int n_neighbours = 27;
    for (int i = n_neighbours / 2 + 1; i < n_neighbours; ++i)
        visit(PointNumbers::Place{cell[0] + i / 9 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i % 3 - 1});
}

/// Joins points that are near each other, directly or through others.
/// @returns for each point the lowest point with which it is joined.
std::vector<Index> join_near(const std::vector<PointNumbers::Place>& points, double distance)
{
    // Points in a cell of more points than this are too many to be duplicates of each other: they are not joined.
    constexpr Index most_copies = 64;
    PointNumbers cells;
    const IndexLists in_cell = [&] {
        std::vector<Index> cell_of;
        for (const PointNumbers::Place& p : points)
            cell_of.push_back(
                cells({std::floor(p[0] / distance), std::floor(p[1] / distance), std::floor(p[2] / distance)}));
        return make_lists(static_cast<Index>(cells.points().size()), [&](auto&& add) {
            for (std::size_t i = 0; i < cell_of.size(); ++i)
                add(cell_of[i], static_cast<Index>(i));
        });
    }();
    DisjointSets sets(static_cast<Index>(points.size()), run_serially);
    const auto join_if_near = [&](Index i, Index j) {
        const PointNumbers::Place& p = points[i];
        const PointNumbers::Place& q = points[j];
        if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= distance)
            sets.join(i, j);
    };
    for (Index c = 0; c < in_cell.size(); ++c) {
        const auto here = in_cell[c];
        if (here.size() > most_copies)
            continue;
        for (std::size_t i = 0; i < here.size(); ++i)
            for (std::size_t j = i + 1; j < here.size(); ++j)
                join_if_near(here[i], here[j]);
        for_half_of_neighbours(cells.points()[c], [&](const PointNumbers::Place& neighbour) {
            const Index other = cells.find(neighbour);
            if (other < 0 || in_cell[other].size() > most_copies)
                return;
            for (const Index i : here)
                for (const Index j : in_cell[other])
                    join_if_near(i, j);
        });
    }
    return sets.all_lowest(run_serially);
}

/// The boundary edges of a mesh, with the numbers of the positions of their ends: equal, or near each other (see
/// join_near), positions have the same number.
class Rims {
  public:
    Rims(const PolygonMesh& mesh, const Topology& topology, double distance, const Executor& exec)
        : mesh_(mesh)
        , topology_(topology)
        , distance_(distance)
    {
        // Edges of three faces have no twins either.
        const auto is_on_boundary = [&](Index v) { return topology.kind[v] == VertexKind::Boundary; };
        halfedges_ = select(exec, mesh.n_corners(), [&](Index h) {
            return topology.twin[h] < 0 && is_on_boundary(start(h)) && is_on_boundary(end(h));
        });
        number_places();
    }

    /// The pairs of boundary half-edges that can be joined (see weld), ascending.
    [[nodiscard]] std::vector<std::array<Index, 2>> pairs() const;

    [[nodiscard]] Index start(Index h) const { return mesh_.face_vertices[h]; }
    [[nodiscard]] Index end(Index h) const { return mesh_.face_vertices[topology_.next(mesh_, h)]; }

  private:
    /// The position of vertex v.
    [[nodiscard]] PointNumbers::Place place(Index v) const
    {
        return {mesh_.vertices(v, 0), mesh_.vertices(v, 1), mesh_.vertices(v, 2)};
    }

    /// Whether two vertices have equal positions, or lie within the distance.
    [[nodiscard]] bool is_near(Index v, Index w) const
    {
        return v == w || place(v) == place(w) ||
               (distance_ > 0.0 && (mesh_.vertices.row(v) - mesh_.vertices.row(w)).norm() <= distance_);
    }

    /// Numbers the positions of the ends of half-edges: sets places_ and n_places_.
    void number_places()
    {
        PointNumbers numbers;
        for (const Index h : halfedges_)
            places_.push_back({numbers(place(start(h))), numbers(place(end(h)))});
        n_places_ = static_cast<Index>(numbers.points().size());
        if (distance_ == 0.0)
            return;
        const std::vector<Index> lowest = join_near(numbers.points(), distance_);
        for (auto& [first, second] : places_) {
            first = lowest[first];
            second = lowest[second];
        }
    }

    /// Whether the faces of two half-edges of opposite directions lie on each other, judging by their adjacent edges,
    /// like the two sheets of a leaf.
    [[nodiscard]] bool lie_on_each_other(Index h, Index other) const
    {
        const auto after = [&](Index one) { return end(topology_.next(mesh_, one)); };
        const auto before = [&](Index one) { return start(topology_.previous(mesh_, one)); };
        return is_near(after(h), before(other)) && is_near(before(h), after(other));
    }

    /// Whether two half-edges run in opposite directions between near vertices, and their faces do not lie on each
    /// other.
    [[nodiscard]] bool fit(Index h, Index other) const
    {
        return is_near(start(h), end(other)) && is_near(end(h), start(other)) && !lie_on_each_other(h, other);
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    double distance_;
    /// The half-edges of the boundary, ascending; and the numbers of the positions of their starts and ends.
    std::vector<Index> halfedges_;
    std::vector<std::array<Index, 2>> places_;
    Index n_places_ = 0;
};

std::vector<std::array<Index, 2>> Rims::pairs() const
{
    const IndexLists at_lower_place = make_lists(n_places_, [&](auto&& add) {
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (places_[i][0] != places_[i][1])
                add(std::min(places_[i][0], places_[i][1]), static_cast<Index>(i));
    });
    std::vector<std::array<Index, 2>> found;
    // The half-edges whose lower end has the number p, sorted by the number of the other end. Half-edges with the same
    // two ends may be a pair if there are two of them.
    std::vector<std::pair<Index, Index>> by_other_place;
    for (Index p = 0; p < n_places_; ++p) {
        by_other_place.clear();
        for (const Index i : at_lower_place[p])
            by_other_place.emplace_back(std::max(places_[i][0], places_[i][1]), i);
        std::sort(by_other_place.begin(), by_other_place.end());
        for (auto first = by_other_place.begin(); first != by_other_place.end();) {
            const auto last =
                std::find_if(first, by_other_place.end(), [&](const auto& one) { return one.first != first->first; });
            if (last - first == 2) {
                const Index i = first[0].second;
                const Index j = first[1].second;
                if (places_[i][0] == places_[j][1] && fit(halfedges_[i], halfedges_[j]))
                    found.push_back({halfedges_[i], halfedges_[j]});
            }
            first = last;
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// A mesh in which pairs of boundary edges are joined.
class Welding {
  public:
    Welding(const PolygonMesh& mesh, const Rims& rims, std::vector<std::array<Index, 2>> pairs, const Executor& exec)
        : mesh_(mesh)
        , rims_(rims)
        , exec_(exec)
        , pairs_(std::move(pairs))
    {
        join();
    }

    /// Gives up pairs that would make the mesh worse, and sets topology_ if pairs are left. Giving up a pair makes
    /// nothing else worse, because it opens fans of faces, and brings no edges together.
    void mend()
    {
        give_up(twice_in_faces());
        if (pairs_.empty())
            return;
        topology_ = make_topology(welded_, exec_);
        std::vector<std::uint8_t> is_bad(representative_.size(), 0);
        for_each(exec_, mesh_.n_vertices(),
                 [&](Index v) { is_bad[v] = topology_.kind[v] == VertexKind::NonManifold ? 1 : 0; });
        if (give_up(is_bad) && !pairs_.empty())
            topology_ = make_topology(welded_, exec_);
    }

    /// Moves out the result; nothing if no pair is left.
    std::optional<Weld> take();

  private:
    /// Sets representative_ and the faces of welded_ for the present pairs.
    void join()
    {
        DisjointSets sets(mesh_.n_vertices(), exec_);
        for (const auto& [h, other] : pairs_) {
            sets.join(rims_.start(h), rims_.end(other));
            sets.join(rims_.end(h), rims_.start(other));
        }
        representative_ = sets.all_lowest(exec_);
        welded_.face_offsets = mesh_.face_offsets;
        welded_.face_vertices.resize(mesh_.face_vertices.size());
        for_each(exec_, mesh_.n_corners(),
                 [&](Index h) { welded_.face_vertices[h] = representative_[mesh_.face_vertices[h]]; });
        // The topology does not depend on positions.
        welded_.vertices.resize(mesh_.n_vertices(), 3);
    }

    /// #V: 1 for each vertex that would occur twice in a face.
    [[nodiscard]] std::vector<std::uint8_t> twice_in_faces() const
    {
        const auto faces = select(exec_, mesh_.n_faces(), [&](Index f) {
            const auto is_joined = [&](Index v) { return representative_[v] != v; };
            return std::ranges::any_of(mesh_.face(f), is_joined);
        });
        std::vector<std::uint8_t> is_twice(representative_.size(), 0);
        std::vector<Index> corners;
        for (const Index f : faces) {
            corners.assign(welded_.face(f).begin(), welded_.face(f).end());
            std::sort(corners.begin(), corners.end());
            for (auto twin = corners.begin(); (twin = std::adjacent_find(twin, corners.end())) != corners.end(); ++twin)
                is_twice[*twin] = 1;
        }
        return is_twice;
    }

    /// Gives up the pairs that end at bad vertices.
    /// @param is_bad #V, by representatives. @returns whether there were such pairs.
    bool give_up(const std::vector<std::uint8_t>& is_bad)
    {
        const auto ends_badly = [&](const std::array<Index, 2>& pair) {
            return is_bad[representative_[rims_.start(pair[0])]] != 0 ||
                   is_bad[representative_[rims_.end(pair[0])]] != 0;
        };
        if (std::erase_if(pairs_, ends_badly) == 0)
            return false;
        join();
        return true;
    }

    const PolygonMesh& mesh_;
    const Rims& rims_;
    const Executor& exec_;
    std::vector<std::array<Index, 2>> pairs_;
    std::vector<Index> representative_;
    PolygonMesh welded_;
    Topology topology_;
};

/// Moves representatives to the mean of the positions that were merged.
/// @returns the number of vertices that were merged with others.
Index move_to_means(const std::vector<Index>& representative, Points& positions)
{
    const auto n = static_cast<Index>(representative.size());
    std::vector<Index> merged;
    std::vector<Index> kept;
    for (Index v = 0; v < n; ++v)
        if (representative[v] != v) {
            merged.push_back(v);
            kept.push_back(representative[v]);
        }
    sort_unique(kept);
    // The mean of equal positions is exactly the same position.
    Points offsets = Points::Zero(std::ssize(kept), 3);
    std::vector<int> counts(kept.size(), 1);
    for (const Index v : merged) {
        const auto i = place_in(kept, representative[v]);
        offsets.row(i) += positions.row(v) - positions.row(representative[v]);
        ++counts[static_cast<std::size_t>(i)];
    }
    for (std::size_t i = 0; i < kept.size(); ++i)
        positions.row(kept[i]) += offsets.row(static_cast<Eigen::Index>(i)) / counts[i];
    return static_cast<Index>(merged.size() + kept.size());
}

std::optional<Weld> Welding::take()
{
    if (pairs_.empty())
        return {};
    copy(exec_, mesh_.vertices, welded_.vertices);
    const Index n_vertices = move_to_means(representative_, welded_.vertices);
    return Weld{.mesh = std::move(welded_),
                .topology = std::move(topology_),
                .representative = std::move(representative_),
                .n_vertices = n_vertices,
                .n_edges = static_cast<Index>(pairs_.size())};
}

}  // namespace

std::optional<Weld> weld(const PolygonMesh& mesh, const Topology& topology, double distance, const Executor& exec)
{
    const Rims rims(mesh, topology, distance, exec);
    std::vector<std::array<Index, 2>> pairs = rims.pairs();
    if (pairs.empty())
        return {};
    Welding welding(mesh, rims, std::move(pairs), exec);
    welding.mend();
    return welding.take();
}

std::optional<Remark> remark_on_seams(Index n_vertices, Index n_edges, std::int64_t n_of_mesh, double distance,
                                      double apart)
{
    const Remark::Numbers numbers{{"vertices", n_vertices}, {"pairs of edges", n_edges}, {"distance", distance}};
    if (n_vertices == 0 && distance == 0.0)
        return {};
    if (n_vertices == 0)
        return Remark(
            "seams", numbers,
            {fmt::format("<weld> has joined no vertices: no seam has pairs of boundary edges within {:.3g} of "
                         "each other, or they are nearer to further ones, too.",
                         distance)});
    // Vertices at most this far apart, in mean edge lengths, differ by rounding: they are meant to be one, even if all
    // vertices of a mesh are such duplicates.
    constexpr double copies_apart = 0.01;
    const bool are_many = apart > copies_apart && std::int64_t{10} * n_vertices >= n_of_mesh;
    const std::string warning =
        are_many ? fmt::format(", and {:.0f}% of all: if so many are no copies of others, make <weld> smaller",
                               100.0 * n_vertices / static_cast<double>(n_of_mesh))
                 : "";
    return Remark("seams", numbers,
                  {fmt::format("{} vertices along seams, where {} of boundary edges lie {}, flowed as one; they are "
                               "still separate vertices{}.",
                               n_vertices, n_edges == 1 ? "1 pair" : fmt::format("{} pairs", n_edges),
                               distance > 0.0 ? fmt::format("within {:.3g} of each other", distance) : "on each other",
                               warning)});
}

}  // namespace seamflow
