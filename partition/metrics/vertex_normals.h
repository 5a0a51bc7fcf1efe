#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The vertex normals of a mesh at any positions: the sum of the vector areas of the faces around a vertex, so that
/// large faces count more. It is the direction in which the vertex adds most to the volume below the surface. Faces
/// need not be oriented alike: around each vertex they are oriented like the first face of their fan, that of the
/// lowest corner, which decides the sign.
class VertexNormals {
  public:
    /// @param mesh, topology must outlive the normals.
    VertexNormals(const PolygonMesh& mesh, const Topology& topology);

    /// The normal of a vertex, of length 1; 0 if it has none: without faces, if their vector areas add up to 0, or at
    /// vertices of kind Junction.
    /// @param positions #V by 3, not necessarily those of the mesh.
    [[nodiscard]] Point operator()(Index v, const Points& positions) const;

    /// The normal of only the faces of some corners, all at one vertex.
    [[nodiscard]] Point operator()(std::span<const Index> corners, const Points& positions) const;

    /// 1; -1 if the face of a corner is oriented against the first face of its fan around the corner's vertex.
    [[nodiscard]] std::int8_t sense(Index corner) const { return sense_.empty() ? std::int8_t{1} : sense_[corner]; }

  private:
    const PolygonMesh& mesh_;
    const Topology& topology_;
    /// One sign per corner; empty: 1 everywhere.
    std::vector<std::int8_t> sense_;
};

}  // namespace seamflow
