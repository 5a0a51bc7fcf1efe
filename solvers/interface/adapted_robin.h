#pragma once

#include <span>

#include "solvers/interface/derivatives.h"

namespace seamflow {

/// The adapted Robin condition of the paper (eq. adaptedVentcell A with q = 0) at the i-th vertex of Γ, where this
/// sub-mesh is the first to solve: (I + dt p ∂n_A) V_A^{k+1} = (I - dt p ∂n_B) V_B^k, with A the sub-mesh and B the
/// complement fan, each with its own outward conormal. Where one of the two conormals does not exist, p counts as 0 and
/// the vertex keeps its place.
/// @param positions #local by 3, the halo included: Vᵏ.
/// @param dt_p dt · p, in length.
/// @param row receives the left-hand side, one coefficient per vertex of the stencil.
/// @returns the right-hand side.
Point adapted_robin_row(const SubMesh& sub_mesh, const DerivativeStencils& stencils, Index i, const Points& positions,
                        double dt_p, std::span<double> row);

}  // namespace seamflow
