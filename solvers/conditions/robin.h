#pragma once

#include <memory>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// The classical Robin condition (paper, eqs. 20 and 21 with q = 0): (I + dt p ∂n) V_A^{k+1} = (I + dt p ∂n)
/// V_B, with V_B the other side's own copy of Γ and what lies beyond. n is A's outward conormal; on the right it is
/// taken as the opposite of B's, so that a flat mesh stays as it is. Otherwise as AdaptedRobin.
/// @param sub_mesh must outlive the condition.
std::unique_ptr<TransmissionCondition> make_robin(const SubMesh& sub_mesh);

}  // namespace seamflow
