#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "partition/executor.h"
#include "partition/metrics/bounding_box.h"
#include "partition/point_numbers.h"
#include "partition/polygon_mesh.h"
#include "samples/tiles/tile_files.h"

/// A tile with bands of the tiles around it, as one mesh.
namespace seamflow {

/// Whether two boxes have a point in common.
bool meet(const BoundingBox& a, const BoundingBox& b);

/// The box around positions, a point at the origin if there are none.
BoundingBox box_around(const Points& positions);

/// A box that is larger by this length on every side.
BoundingBox inflated(const BoundingBox& box, double length);

/// The points within some length of given ones, and a few further ones: at most 1.5 times as far away in each
/// coordinate.
class Neighbourhood {
  public:
    /// @param points #P by 3. @param width positive, in units of length.
    Neighbourhood(const Points& points, double width);

    [[nodiscard]] bool is_empty() const { return cells_.points().empty(); }

    /// No point outside of this box is in the neighbourhood.
    [[nodiscard]] const BoundingBox& box() const { return box_; }

    [[nodiscard]] bool contains(const Point& point) const;

    /// #V: 1 for the positions that it contains.
    [[nodiscard]] std::vector<std::uint8_t> select(const Points& positions, const Executor& exec) const;

  private:
    [[nodiscard]] PointNumbers::Place cell_at(const Point& point) const;

    double cell_;
    BoundingBox box_;
    PointNumbers cells_;
};

/// Faces of several tiles as one mesh, in which the vertices of their borders are one where they have the same owner.
class TileUnion {
  public:
    /// Adds the faces of a tile that have a wanted vertex. Vertices of these faces that are not wanted are held,
    /// because the union lacks some of their faces; so are those that owners hold. Tiles have to be added one after
    /// another, each once.
    /// @param is_wanted #V. @param positions #V by 3.
    /// @returns #V: the numbers of the vertices in the union, -1 for those that it lacks.
    std::vector<Index> add(const TileFaces& faces, const TileOwners& owners, const Points& positions,
                           std::span<const std::uint8_t> is_wanted);

    [[nodiscard]] PolygonMesh& mesh() { return mesh_; }

    /// The vertices that do not move.
    [[nodiscard]] const std::vector<Index>& held() const { return held_; }

  private:
    /// The number of each vertex of some faces in the union, -1 for others.
    std::vector<Index> number(const std::vector<Index>& used, const TileOwners& owners, const Points& positions);

    PolygonMesh mesh_;
    std::vector<Index> held_;
    /// The numbers of vertices on borders, by the tiles and numbers of their owners.
    std::unordered_map<std::uint64_t, Index> number_of_owner_;
};

}  // namespace seamflow
