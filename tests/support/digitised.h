#pragma once

#include <functional>

#include "partition/polygon_mesh.h"

namespace seamflow::test {

/// Whether a point is inside of a body.
using Inside = std::function<bool(const Point& point)>;

/// The faces of the unit cubes, of n by n by n around the origin, whose middles are inside, towards those outside:
/// quads, turned outwards. Coordinates are multiples of 1, plus a half if n is odd.
PolygonMesh voxel_faces(const Inside& inside, Index n);

/// The material at a point; 0 outside of all.
using Materials = std::function<Index(const Point& point)>;

/// The faces of the unit cubes, of n by n by n around the origin, between different materials: each face once, with all
/// others on one mesh. Beyond the cubes the material is 0.
PolygonMesh wall_faces(const Materials& material, Index n);

/// The surface of marching cubes between points of a lattice of n by n by n, of which some are inside: one polygon for
/// each piece of the surface in a cube, turned outwards; its corners are the middles of the edges of the cube that
/// cross the surface.
/// @param spacing of the lattice in x, y and z; its middle is the origin.
PolygonMesh crossed_edges(const Inside& inside, Index n, const Point& spacing = Point::Ones());

/// A grid of n by n vertices at whole numbers, each square divided into two triangles, with these heights.
PolygonMesh height_grid(Index n, const std::function<double(double x, double y)>& height);

/// A mesh whose coordinates are rounded to multiples of the steps of x, y and z; those with a step of 0 stay.
PolygonMesh rounded(PolygonMesh mesh, const Point& steps);

/// The ball of this radius around the origin.
Inside ball(double radius);

/// A pyramid of blocks: square storeys, each this high, and narrower than that below by the depth of a step on each
/// side.
Inside stepped_pyramid(double height, double depth);

}  // namespace seamflow::test
