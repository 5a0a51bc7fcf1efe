#pragma once

#include <array>
#include <span>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The vertices of a triangle.
using Triangle = std::array<Index, 3>;

/// Cuts a polygon of n corners, convex or not, planar or not, into n − 2 triangles by diagonals. These represent the
/// surface of the polygon. The polygon is seen along its vector area. An ear is a corner that can be cut off without
/// crossing the polygon. The ear with the shortest diagonal in space is cut off first, and so on until three corners
/// are left; a convex quad is thus divided along its shorter diagonal. The result depends neither on the first corner
/// of the list nor on its sense, except for the order and sense of the triangles: of diagonals of the same length, that
/// of the ear with the lowest number is used. Polygons that cross themselves in this view, or have no area, are also
/// covered by n − 2 triangles.
/// @param corners at least three vertices, in order.
/// @param positions #V by 3.
/// @param triangles receives the triangles, some of them without area if corners are collinear or coincide.
void triangulate(std::span<const Index> corners, const Points& positions, std::vector<Triangle>& triangles);

/// All triangles of all faces, face by face.
std::vector<Triangle> triangulate(const PolygonMesh& mesh);

/// A mesh in triangles that look like its faces, which need not be planar: each face of more than three corners becomes
/// a fan of triangles around its centre, the mean of its corners. A face whose corners do not all turn the same way
/// around its centre, such as a polygon far from convex, is cut along its diagonals instead (see triangulate).
struct CentreFans {
    /// The triangles. The first #V vertices are those of the mesh; the centres follow.
    PolygonMesh triangles;
    /// One per triangle: the face to which it belongs.
    std::vector<Index> faces;
};

/// Divides the faces of a mesh into triangles, see CentreFans.
/// @param positions #V by 3, not necessarily those of the mesh.
CentreFans fans_around_centres(const PolygonMesh& mesh, const Points& positions);

}  // namespace seamflow
