#pragma once

#include <cstdint>
#include <span>

#include "partition/polygon_mesh.h"

/// Meshes of sheets that meet along edges of three faces or more.
namespace seamflow::test {

/// Half-planes that begin at the z axis, one at each angle (in radians, counterclockwise from the x axis): grids of m
/// squares outwards and n along the axis, of edge length 1. The vertices of the axis come first, n + 1 of them, then
/// those of one plate after the other, (n + 1) for each distance from the axis.
PolygonMesh plates(std::span<const double> angles, Index m, Index n);

/// Cells around `n_seeds` random points in a box of `size` unit cubes along each axis, with the surface of the box: a
/// foam of quads whose edges have three sheets, and whose corners four.
PolygonMesh foam(Index size, int n_seeds, std::uint32_t seed);

/// Two balls with a common wall, the mirror images of each other in z, of quads of edge length 1 in a box of this size.
PolygonMesh touching_balls(Index size);

/// The mesh with every quad cut in two.
PolygonMesh cut_into_triangles(const PolygonMesh& quads);

}  // namespace seamflow::test
