#pragma once

#include <optional>
#include <span>

#include "partition/metrics/vertex_normals.h"

namespace seamflow {

/// New normals for those that a file holds, after its vertices have moved. A normal that pointed to the back of its
/// faces does so again.
class MovedNormals {
  public:
    /// @param mesh where the vertices are now; has to outlive this object.
    /// @param before #V by 3, where they were.
    MovedNormals(const PolygonMesh& mesh, Points before);
    MovedNormals(const MovedNormals&) = delete;
    MovedNormals& operator=(const MovedNormals&) = delete;

    /// The normal of the faces of some corners at one vertex (see VertexNormals), of length 1.
    /// @param given the normal before; what is not a number does not matter.
    /// @returns nothing if it stays: the faces have not moved, or have no normal now.
    [[nodiscard]] std::optional<Point> around_vertex(std::span<const Index> corners, const Point& given) const;

    /// The same for all corners at vertex v.
    [[nodiscard]] std::optional<Point> around_vertex(Index v, const Point& given) const
    {
        return around_vertex(topology_.corners_at(v), given);
    }

    /// The same for one face.
    [[nodiscard]] std::optional<Point> of_face(Index f, const Point& given) const;

    [[nodiscard]] Index face_of(Index corner) const { return topology_.face_of[corner]; }

    /// Whether any vertex has moved.
    [[nodiscard]] bool moved() const { return before_ != mesh_.vertices; }

  private:
    const PolygonMesh& mesh_;
    Points before_;
    Topology topology_;
    VertexNormals normals_;
};

}  // namespace seamflow
