#pragma once

#include "partition/topology.h"

namespace seamflow {

/// How far from smooth a mesh is: the root mean square, over all edges between two faces, of the angle between the
/// vector areas of these faces, in degrees; 180 where the surface folds back onto itself. Smoothing lowers it, spikes
/// raise it. Faces without area, and positions that are not finite, are left out.
/// @param positions #V by 3, not necessarily those of the mesh.
double roughness(const PolygonMesh& mesh, const Topology& topology, const Points& positions);

}  // namespace seamflow
