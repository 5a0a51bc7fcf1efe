#pragma once

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A mesh in triangles as an eye sees its faces, which need not be planar: each face of more than three corners becomes
/// a fan of triangles around its centre, the mean of its corners. A face whose corners do not all turn the same way
/// around its centre, as of a polygon that is far from convex, is cut along its diagonals instead (see triangulate).
struct CentreFans {
    /// Its first #V vertices are those of the mesh; the centres follow.
    PolygonMesh triangles;
    /// One per triangle: the face that it is a part of.
    std::vector<Index> faces;
};

/// @param positions #V by 3, not necessarily those of the mesh.
CentreFans fans_around_centres(const PolygonMesh& mesh, const Points& positions);

}  // namespace seamflow
