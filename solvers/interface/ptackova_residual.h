#pragma once

#include "partition/topology.h"
#include "solvers/geometry.h"

namespace seamflow {

/// The row of the undecomposed step with Δ_P at a vertex of the whole mesh, multiplied by the area M_v of the vertex:
/// M_v (Vᵏ⁺¹ - Vᵏ + dt Δ_P(Vᵏ) Vᵏ⁺¹). Evaluated without a matrix: the row reaches two rings.
/// @param before, after #V by 3: Vᵏ and Vᵏ⁺¹.
/// @param time_step dt, in length².
/// @param v a vertex of kind Interior.
Point ptackova_residual(const PolygonMesh& mesh, const Topology& topology, const Points& before, const Points& after,
                        double time_step, Index v);

}  // namespace seamflow
