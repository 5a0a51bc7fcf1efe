#pragma once

#include <memory>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// The classical Ventcell condition (paper, eqs. 20 and 21): (I + dt (p ∂n + q ∂t)) V_A^{k+1} = (I + dt (p ∂n +
/// q ∂t)) V_B, with V_B as for the classical Robin condition and the tangential derivative along either side's own copy
/// of Γ, whose lengths are those of Vᵏ.
/// @param sub_mesh must outlive the condition.
/// @param q not negative, without dimension.
std::unique_ptr<TransmissionCondition> make_ventcell(const SubMesh& sub_mesh, double q);

}  // namespace seamflow
