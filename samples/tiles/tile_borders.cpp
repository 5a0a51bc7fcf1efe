#include "samples/tiles/tile_borders.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "partition/index_lists.h"
#include "partition/weld.h"

namespace seamflow {

namespace {

/// The borders of several tiles as one mesh, in which vertices that are one are joined.
class JoinedBorders {
  public:
    JoinedBorders(std::span<const BorderOfTile> near, double distance, const Executor& exec)
        : near_(near)
    {
        for (std::size_t place = 0; place < near.size(); ++place)
            append(static_cast<Index>(place), near[place].border);
        joined_ = weld(mesh_, make_topology(mesh_, exec), distance, exec);
    }

    [[nodiscard]] Index n_vertices() const { return static_cast<Index>(origins_.size()); }
    [[nodiscard]] const BorderOfTile& tile_of(Index i) const { return near_[usize(origins_[i].place)]; }
    [[nodiscard]] Index vertex_of(Index i) const { return tile_of(i).border.vertices[origins_[i].number]; }
    [[nodiscard]] bool is_on_border(Index i) const { return tile_of(i).border.is_on_border[origins_[i].number] != 0; }

    /// The lowest of the vertices that are one, and so the one of the lowest tile.
    [[nodiscard]] Index lowest(Index i) const
    {
        // Behind the faces here the surface of a tile goes on: where they end there, no seam is.
        const bool is_joined = joined_ && is_on_border(i) && is_on_border(joined_->representative[i]);
        return is_joined ? joined_->representative[i] : i;
    }

  private:
    /// The tile, by its place in the list, and the place of the vertex in its border.
    struct Origin {
        Index place;
        Index number;
    };

    void append(Index place, const TileBorder& border)
    {
        const auto first = static_cast<Index>(origins_.size());
        const auto n = static_cast<Index>(border.vertices.size());
        mesh_.vertices.conservativeResize(first + n, 3);
        mesh_.vertices.bottomRows(n) = border.positions;
        for (Index i = 0; i < n; ++i)
            origins_.push_back({place, i});
        const Index first_corner = mesh_.n_corners();
        for (const Index v : border.face_vertices)
            mesh_.face_vertices.push_back(first + v);
        for (std::size_t f = 1; f < border.face_offsets.size(); ++f)
            mesh_.face_offsets.push_back(first_corner + border.face_offsets[f]);
    }

    std::span<const BorderOfTile> near_;
    PolygonMesh mesh_;
    std::vector<Origin> origins_;
    /// Empty where nothing is joined.
    std::optional<Weld> joined_;
};

/// #V: 1 for the lowest of vertices that are one where these are of several tiles.
std::vector<std::uint8_t> shared_by_tiles(const JoinedBorders& all)
{
    std::vector<std::uint8_t> is_shared(usize(all.n_vertices()), 0);
    for (Index i = 0; i < all.n_vertices(); ++i)
        if (all.tile_of(i).tile != all.tile_of(all.lowest(i)).tile)
            is_shared[all.lowest(i)] = 1;
    return is_shared;
}

}  // namespace

TileBorder border_of(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const auto is_on_border = [&](Index v) { return topology.kind[v] == VertexKind::Boundary; };
    const std::vector<Index> faces =
        select(exec, mesh.n_faces(), [&](Index f) { return std::ranges::any_of(mesh.face(f), is_on_border); });
    TileBorder border;
    border.non_manifold =
        select(exec, mesh.n_vertices(), [&](Index v) { return topology.kind[v] == VertexKind::NonManifold; });
    for (const Index f : faces)
        border.vertices.insert(border.vertices.end(), mesh.face(f).begin(), mesh.face(f).end());
    sort_unique(border.vertices);
    border.positions.resize(std::ssize(border.vertices), 3);
    for (std::size_t i = 0; i < border.vertices.size(); ++i) {
        border.is_on_border.push_back(is_on_border(border.vertices[i]) ? 1 : 0);
        border.positions.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(border.vertices[i]);
    }
    for (const Index f : faces) {
        for (const Index v : mesh.face(f))
            border.face_vertices.push_back(find_in(border.vertices, v));
        border.face_offsets.push_back(static_cast<Index>(border.face_vertices.size()));
    }
    return border;
}

TileOwners owners_of(Index tile, std::span<const BorderOfTile> near, double distance, const Executor& exec)
{
    const JoinedBorders all(near, distance, exec);
    const std::vector<std::uint8_t> is_shared = shared_by_tiles(all);
    TileOwners owners;
    for (Index i = 0; i < all.n_vertices(); ++i) {
        if (all.tile_of(i).tile != tile || !all.is_on_border(i))
            continue;
        const Index lowest = all.lowest(i);
        const BorderOfTile& first = all.tile_of(lowest);
        owners.vertices.push_back(all.vertex_of(i));
        owners.is_shared.push_back(is_shared[lowest]);
        if (first.tile == tile) {
            owners.tiles.push_back(tile);
            owners.numbers.push_back(all.vertex_of(lowest));
            continue;
        }
        // That vertex may have an owner in a tile lower still, which is not near.
        const Index place = find_in(first.owners.vertices, all.vertex_of(lowest));
        owners.tiles.push_back(first.owners.tiles.at(usize(place)));
        owners.numbers.push_back(first.owners.numbers.at(usize(place)));
    }
    return owners;
}

}  // namespace seamflow
