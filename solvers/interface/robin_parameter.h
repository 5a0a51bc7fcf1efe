#pragma once

#include "partition/decomposition/sub_mesh.h"
#include "solvers/geometry.h"

namespace seamflow {

/// p* of a sub-mesh (paper, eq. ourP, after Gander 2006): (((π/l)² + 1)((π/‖e‖)² + 1))^¼, in 1/length, with ‖e‖ its
/// shortest edge and l the largest distance from Γ along its edges (for a strip with Γ on one side, its width). Edges
/// of length zero carry no frequency and do not count; where every vertex lies on Γ, l is ‖e‖.
/// @param positions #local by 3.
/// @returns 0 for a sub-mesh without Γ or without an edge of positive length.
double optimal_robin_parameter(const SubMesh& sub_mesh, const Points& positions);

}  // namespace seamflow
