#pragma once

#include "partition/loop.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Estimates the noise of a mesh from itself: the standard deviation of what its vertices are off the surface, along
/// the normals. A quadratic height function is fitted to the two rings around a vertex, without the vertex (least
/// squares, over the plane that fits them best); how far the vertex is from it, over what the fit's own noise adds, is
/// its residual. The median residual over some ten thousand interior vertices, spread evenly, over that of a normal
/// distribution of deviation 1, is the estimate (the median absolute deviation: Rousseeuw and Croux, Alternatives to
/// the Median Absolute Deviation, 1993). Edges and spikes do not count as long as they are few; bends as narrow as the
/// rings do.
/// @returns in units of length; 0 where no vertex has rings to fit to.
double estimate_noise(const PolygonMesh& mesh, const Topology& topology, const Loop& loop = run_serially);

}  // namespace seamflow
