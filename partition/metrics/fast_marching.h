#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The distances of vertices from the nearest of some vertices along the surface, by fast marching over the faces
/// (Kimmel, Sethian, Computing geodesic paths on manifolds, 1998), along edges and diagonals of faces where that fails:
/// exact from straight rims on flat triangles that are not obtuse, about a tenth too long elsewhere.
/// @param topology of the mesh. @param sources in any order.
/// @returns #V, in length; infinite at vertices that are not connected to a source, or farther than `most`.
std::vector<double> distances_from(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> sources,
                                   double most);

}  // namespace seamflow
