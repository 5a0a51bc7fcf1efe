#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

/// Meshes of sheets that meet along edges of three faces or more.
namespace seamflow::test {

/// Half-planes that begin at the z axis, one at each angle (in radians, counterclockwise from the x axis): grids of m
/// squares outwards and n along the axis, of edge length 1. The vertices of the axis come first, n + 1 of them, then
/// those of one plate after the other, (n + 1) for each distance from the axis.
PolygonMesh plates(std::span<const double> angles, Index m, Index n);

/// The faces between cubes of different labels in a box of unit cubes, as of segmented images: quads.
/// @param size cubes along each axis. @param label of the cube around a point; negative: there is nothing, nor are
/// there
///        faces. Nothing is around the box.
PolygonMesh faces_between(Index size, const std::function<int(const Point&)>& label);

/// Cells around `n_seeds` random points in a box, with the surface of the box: a foam whose edges have three sheets,
/// and whose corners four.
PolygonMesh foam(Index size, int n_seeds, std::uint32_t seed);

/// Two balls with a common wall, the mirror images of each other in z.
PolygonMesh touching_balls(Index size);

/// The mesh with every quad cut in two.
PolygonMesh cut_into_triangles(const PolygonMesh& quads);

}  // namespace seamflow::test
