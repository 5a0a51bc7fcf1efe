#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// One of the half-edges at an edge where sheets meet.
struct SheetSpoke {
    /// The angle of its face around the edge, in radians, from -π to π.
    double angle;
    /// The derivative of the angle while each vertex moves in a direction of its own: decides between equal angles.
    double rate;
    Index halfedge;
    /// Whether the face has the direction of the previous one, so that the two lie on each other.
    bool lies_on_previous;
};

/// The order of the faces around an edge where sheets meet.
class SheetOrder {
  public:
    /// @param positions #V by 3, not necessarily those of the mesh. @param topology after free_junctions.
    SheetOrder(const PolygonMesh& mesh, const Points& positions, const Topology& topology)
        : mesh_(mesh)
        , positions_(positions)
        , topology_(topology)
    {
    }

    /// Whether half-edge h runs from the lower to the higher vertex. Angles are counterclockwise about this direction.
    [[nodiscard]] bool runs_up(Index h) const
    {
        return mesh_.face_vertices[h] < mesh_.face_vertices[topology_.next(mesh_, h)];
    }

    /// All half-edges at the edge of half-edge h of a junction, counterclockwise. Of n in n log n operations.
    ///
    /// Faces that lie on each other are in the order that they would have if each vertex were displaced a little, in a
    /// direction that depends on its number: so the two halves of a flat quad that one sheet cuts along one diagonal
    /// lie on the same side of those of another sheet that cuts along the other, at all four edges. Faces with the same
    /// corners are in the order of their numbers, seen along the half-edge of the lowest.
    [[nodiscard]] std::vector<SheetSpoke> around(Index h) const;

  private:
    [[nodiscard]] SheetSpoke spoke_of(Index h, const Point& axis, Point& first) const;

    const PolygonMesh& mesh_;
    const Points& positions_;
    const Topology& topology_;
};

}  // namespace seamflow
