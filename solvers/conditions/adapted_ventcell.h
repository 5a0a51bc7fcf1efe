#pragma once

#include <memory>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// The adapted Ventcell condition of the paper (eq. 24): (I + dt (p ∂n_A + q ∂t)) V_A^{k+1} = (I - dt p
/// ∂n_B) V_B, with the tangential derivative along Γ, whose lengths are those of Vᵏ; otherwise as AdaptedRobin.
/// Straightens Γ.
/// @param sub_mesh must outlive the condition.
/// @param q not negative, without dimension.
std::unique_ptr<TransmissionCondition> make_adapted_ventcell(const SubMesh& sub_mesh, double q);

}  // namespace seamflow
