#pragma once

#include <cstdint>
#include <vector>

#include "partition/topology.h"

namespace seamflow {

/// The faces of a mesh as triangles to draw, and which of their sides are edges of the mesh.
struct PageTriangles {
    /// Three vertices for each triangle, the triangles face by face (see triangulate).
    std::vector<std::uint32_t> corners;
    /// One per triangle: bit k is set where the side from its corner k to the next one is an edge of the mesh; of the
    /// two sides on an edge of two faces, only one is set.
    std::vector<std::uint8_t> edges;
    /// #F, the number of triangles into which each face is cut.
    std::vector<std::uint32_t> per_face;
};

PageTriangles page_triangles(const PolygonMesh& mesh, const Topology& topology);

}  // namespace seamflow
