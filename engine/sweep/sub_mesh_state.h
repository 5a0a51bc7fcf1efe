#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "solvers/systems/sub_mesh_system.h"

namespace seamflow {

/// One sub-mesh in a sweep. A task of a sub-mesh reads the states of others only as far as a Transfer names their rows,
/// and writes only to its own.
struct SubMeshState {
    const SubMesh* sub_mesh;
    /// The equations of a step; null for a sub-mesh of another rank.
    std::unique_ptr<SubMeshSystem> system;
    /// Robin parameter, in 1/length.
    double p = 0.0;
    /// #local by 3, own vertices, then halo: Vᵏ until the step is accepted, then Vᵏ⁺¹ at own vertices; the halo follows
    /// when the next step assembles.
    Points position;
    /// #local by 3: the solution of the equations, Vᵏ⁺¹ before the correction.
    Points solution;
    /// #local by 3: at own vertices, the solution with Γ fixed at Vᵏ; empty if sub-meshes do not predict.
    Points predicted = Points(0, 3);
    /// #local by 3: what the step is applied to in place of Vᵏ; null: Vᵏ. Only filters have such data.
    const Points* data = nullptr;
    /// The factorisation of the last equations that were assembled, until it is freed.
    std::optional<SubMeshSystem::Factor> factor = std::nullopt;

    /// The positions or data on the right-hand side.
    [[nodiscard]] const Points& given() const { return data != nullptr ? *data : position; }
};

/// The mean over all copies of the i-th vertex of a sub-mesh's Γ.
/// @param array the copies are rows of this array of each state.
inline Point mean_of_copies(const std::vector<SubMeshState>& states, const SubMeshInterface& interface, Index i,
                            Points SubMeshState::*array)
{
    Point sum = Point::Zero();
    for (std::size_t k = 0; k < interface.sharing[i].size(); ++k)
        sum += (states[interface.sharing[i][k]].*array).row(interface.index_in_sharing[i][k]);
    return sum / static_cast<double>(interface.sharing[i].size());
}

}  // namespace seamflow
