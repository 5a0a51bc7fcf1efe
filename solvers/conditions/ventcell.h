#pragma once

#include <memory>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// The adapted Ventcell condition of the paper (eq. 24): (I + dt (p ∂n_A + q ∂t)) V_A^{k+1} = (I - dt p ∂n_B) V_B, with
/// the tangential derivative along Γ, whose lengths are those of Vᵏ; otherwise as AdaptedRobin, equal to it for q = 0.
/// Straightens Γ.
/// @param sub_mesh must outlive the condition.
/// @param q not negative, without dimension.
std::unique_ptr<TransmissionCondition> make_adapted_ventcell(const SubMesh& sub_mesh, double q = 0.0);

/// The classical Ventcell condition (paper, eqs. 20 and 21): (I + dt (p ∂n + q ∂t)) V_A^{k+1} = (I + dt (p ∂n +
/// q ∂t)) V_B, with V_B the other side's own copy of Γ and what lies beyond. n is A's outward conormal; on the right it
/// is taken as the opposite of B's, so that a flat mesh stays as it is. The tangential derivative is that along either
/// side's own copy of Γ, whose lengths are those of Vᵏ. Otherwise as AdaptedRobin; with q = 0 the classical Robin
/// condition.
/// @param sub_mesh must outlive the condition.
/// @param q not negative, without dimension.
std::unique_ptr<TransmissionCondition> make_ventcell(const SubMesh& sub_mesh, double q = 0.0);

}  // namespace seamflow
