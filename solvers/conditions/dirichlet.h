#pragma once

#include <memory>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/conditions/transmission_condition.h"

namespace seamflow {

/// Dirichlet data: V^{k+1} = V^k where a sub-mesh leads; where it follows, as always, the given values. The condition
/// of the alternating Schwarz method (paper, eqs. 18 and 19), in which sub-meshes that overlap follow everywhere.
/// @param sub_mesh needed only during the call; only the vertices of its interface count.
std::unique_ptr<TransmissionCondition> make_dirichlet(const SubMesh& sub_mesh);

}  // namespace seamflow
