#include "samples/tiles/tile_borders.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "partition/index_lists.h"
#include "partition/weld.h"

namespace seamflow {

namespace {

bool may_continue(VertexKind kind)
{
    return kind == VertexKind::Boundary || kind == VertexKind::NonManifold;
}

/// Numbers the vertices of the faces around a border, those of several fans once for each.
class BorderNumbers {
  public:
    BorderNumbers(const PolygonMesh& mesh, const Topology& topology)
        : mesh_(mesh)
        , topology_(topology)
    {
    }

    /// @param faces around the border.
    void number(const std::vector<Index>& faces, TileBorder& border)
    {
        std::vector<Index> vertices;
        for (const Index f : faces)
            vertices.insert(vertices.end(), mesh_.face(f).begin(), mesh_.face(f).end());
        sort_unique(vertices);
        for (const Index v : vertices)
            add(v, border);
    }

    [[nodiscard]] Index of_corner(Index h) const
    {
        const auto of_fan = of_corner_.find(h);
        return of_fan != of_corner_.end() ? of_fan->second : of_vertex_.at(mesh_.face_vertices[h]);
    }

  private:
    void add(Index v, TileBorder& border)
    {
        const auto append = [&] {
            border.vertices.push_back(v);
            border.is_on_border.push_back(may_continue(topology_.kind[v]) ? 1 : 0);
            return static_cast<Index>(border.vertices.size()) - 1;
        };
        if (topology_.kind[v] != VertexKind::NonManifold) {
            of_vertex_.emplace(v, append());
            return;
        }
        for (const Fan& fan : fans_at(mesh_, topology_, v, {}, 0)) {
            const Index number = append();
            for (const Index h : fan.corners)
                of_corner_.emplace(h, number);
        }
    }

    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::unordered_map<Index, Index> of_vertex_;
    std::unordered_map<Index, Index> of_corner_;
};

/// The borders of several tiles as one mesh, in which vertices that are one are joined.
class JoinedBorders {
  public:
    JoinedBorders(std::span<const BorderOfTile> near, double distance, const Executor& exec)
        : near_(near)
    {
        for (std::size_t place = 0; place < near.size(); ++place)
            append(static_cast<Index>(place), near[place].border);
        lowest_.resize(origins_.size());
        std::iota(lowest_.begin(), lowest_.end(), 0);
        join(distance, exec);
    }

    [[nodiscard]] Index n_vertices() const { return static_cast<Index>(origins_.size()); }
    [[nodiscard]] const BorderOfTile& tile_of(Index i) const { return near_[at(origins_[i].place)]; }
    [[nodiscard]] Index vertex_of(Index i) const { return tile_of(i).border.vertices[origins_[i].number]; }
    [[nodiscard]] bool is_on_border(Index i) const { return tile_of(i).border.is_on_border[origins_[i].number] != 0; }

    /// Whether this is another fan of the vertex before it.
    [[nodiscard]] bool is_further_fan(Index i) const
    {
        return i > 0 && origins_[i - 1].place == origins_[i].place && vertex_of(i - 1) == vertex_of(i);
    }

    /// The lowest of the vertices that are one, and so the one of the lowest tile.
    [[nodiscard]] Index lowest(Index i) const { return lowest_[i]; }

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

    void join(double distance, const Executor& exec)
    {
        const std::optional<Weld> joined = weld(mesh_, make_topology(mesh_, exec), distance, exec);
        for (Index i = 0; i < n_vertices(); ++i) {
            // The fans of a vertex are one vertex of the file.
            if (is_further_fan(i))
                join(i - 1, i);
            // Behind the faces here the surface goes on: where faces here end, no seam is.
            if (joined && is_on_border(i) && is_on_border(joined->first[i]))
                join(joined->first[i], i);
        }
        for (Index i = 0; i < n_vertices(); ++i)
            lowest_[i] = find(i);
    }

    void join(Index i, Index j)
    {
        const auto [low, high] = std::minmax({find(i), find(j)});
        lowest_[high] = low;
    }

    Index find(Index i)
    {
        while (lowest_[i] != i)
            i = lowest_[i] = lowest_[lowest_[i]];
        return i;
    }

    std::span<const BorderOfTile> near_;
    PolygonMesh mesh_;
    std::vector<Origin> origins_;
    std::vector<Index> lowest_;
};

/// #V: 1 for the lowest of vertices that are one where these are of several tiles.
std::vector<std::uint8_t> shared_by_tiles(const JoinedBorders& all)
{
    std::vector<std::uint8_t> is_shared(at(all.n_vertices()), 0);
    for (Index i = 0; i < all.n_vertices(); ++i)
        if (all.tile_of(i).tile != all.tile_of(all.lowest(i)).tile)
            is_shared[all.lowest(i)] = 1;
    return is_shared;
}

}  // namespace

TileBorder border_of(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const std::vector<Index> faces = select(exec, mesh.n_faces(), [&](Index f) {
        return std::ranges::any_of(mesh.face(f), [&](Index v) { return may_continue(topology.kind[v]); });
    });
    TileBorder border;
    BorderNumbers numbers(mesh, topology);
    numbers.number(faces, border);
    border.positions.resize(std::ssize(border.vertices), 3);
    for (std::size_t i = 0; i < border.vertices.size(); ++i)
        border.positions.row(static_cast<Eigen::Index>(i)) = mesh.vertices.row(border.vertices[i]);
    for (const Index f : faces) {
        for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h)
            border.face_vertices.push_back(numbers.of_corner(h));
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
        if (all.tile_of(i).tile != tile || !all.is_on_border(i) || all.is_further_fan(i))
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
        const Index place = position_in(first.owners.vertices, all.vertex_of(lowest));
        owners.tiles.push_back(first.owners.tiles.at(at(place)));
        owners.numbers.push_back(first.owners.numbers.at(at(place)));
    }
    return owners;
}

}  // namespace seamflow
