#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The vertex normals of a mesh in any positions: the sum of the vector areas of the faces around a vertex, so that
/// large faces count for more. It is the direction in which the vertex adds most to the volume below the surface. Faces
/// need not be oriented alike: around each vertex they are oriented like the first one (that of the lowest corner) of
/// their fan, which decides the sign.
class VertexNormals {
  public:
    /// @param mesh, topology must outlive the normals.
    VertexNormals(const PolygonMesh& mesh, const Topology& topology);

    /// Of length 1, or 0 where there is none: without faces, if their vector areas add up to 0, or at vertices of kind
    /// Junction.
    /// @param positions #V by 3, not necessarily those of the mesh.
    [[nodiscard]] Point operator()(Index v, const Points& positions) const;

    /// The same for only the faces of some corners, all at one vertex.
    [[nodiscard]] Point operator()(std::span<const Index> corners, const Points& positions) const;

    /// 1, or -1 if the face of a corner is oriented against the first of its fan around the corner's vertex.
    [[nodiscard]] std::int8_t sense(Index corner) const { return sense_.empty() ? std::int8_t{1} : sense_[corner]; }

  private:
    const PolygonMesh& mesh_;
    const Topology& topology_;
    /// One per corner; empty: 1 everywhere.
    std::vector<std::int8_t> sense_;
};

}  // namespace seamflow
