#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

/// The mean curvature of a surface.
namespace seamflow {

/// #V: ‖ΔV‖ at every interior vertex that may move, 0 at the others, in 1/length. On a free boundary ΔV is not the mean
/// curvature. Runs in parallel.
std::vector<double> measure_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      const ScaledLaplacian& laplacian);

/// The largest finite value of a list, in 1/length.
double largest_curvature(const std::vector<double>& curvature);

/// The largest finite value of measure_curvature, without a list of the values.
double measure_largest_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                 const ScaledLaplacian& laplacian);

}  // namespace seamflow
