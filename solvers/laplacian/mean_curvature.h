#pragma once

#include "partition/topology.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The mean curvature vector ΔV at one vertex of the whole mesh, in 1/length: the row of the Laplacian applied to the
/// positions, without assembling anything. Its length is |κ₁ + κ₂| up to discretisation; with Fujiwara it also has a
/// tangential component.
/// @param positions #V by 3.
/// @param v a vertex that moves; on a free boundary the row is no mean curvature.
Point mean_curvature_vector(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                            const ScaledLaplacian& laplacian, Index v);

}  // namespace seamflow
