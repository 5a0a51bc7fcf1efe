#pragma once

#include <vector>

#include "partition/topology.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// ‖ΔV‖ at every interior vertex that may move, 0 at the others, in 1/length; #V. On a free boundary ΔV is not the mean
/// curvature. Runs in parallel.
std::vector<double> measure_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      Laplacian laplacian);

/// The largest finite one of them.
double largest_curvature(const std::vector<double>& curvature);

/// The same without a list of them.
double measure_largest_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                 Laplacian laplacian);

}  // namespace seamflow
