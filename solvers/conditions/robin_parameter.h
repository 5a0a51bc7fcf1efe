#pragma once

#include "partition/polygon_mesh.h"
#include "solvers/conditions/robin_edge.h"

namespace seamflow {

struct SubMesh;

/// p* of a sub-mesh (paper, eqs. 26 and 27, after Gander 2006): ((k_min² + η)(k_max² + η))^¼ with k_min = π / l and
/// k_max = π / ‖e‖, in 1/length; ‖e‖ is an edge of the sub-mesh, and l the largest distance from Γ along its edges (for
/// a strip with Γ on one side, its width). Edges of length zero carry no frequency and do not count; l is at least ‖e‖,
/// as where every vertex lies on Γ.
/// @param positions #local by 3.
/// @param eta η, in 1/length²; the paper's 1 makes p* depend on the unit of length.
/// @returns 0 for a sub-mesh without Γ or without an edge of positive length.
double optimal_robin_parameter(const SubMesh& sub_mesh, const Points& positions, double eta = 1.0,
                               PEdge edge = PEdge::Minimum);

}  // namespace seamflow
