#pragma once

#include <cstdint>
#include <string>

#include "engine/options/flow_options.h"
#include "tests/support/random_meshes.h"

namespace seamflow::test {

/// A mesh and what is to be done with it.
struct RandomFlow {
    RandomMesh input;
    FlowOptions options;

    /// For messages: how the mesh came about, and all options that are not the default.
    [[nodiscard]] std::string description() const;
};

/// Options of any kind for this mesh: Laplacian, conditions, dt of 1e-3 to 1e3 squared mean edges, cut by METIS or by
/// random labels, sweeps, converged and explicit steps, constraints. Most of them go together; some do not.
FlowOptions random_options(const PolygonMesh& mesh, RandomNumbers& random);

/// The same for the same seed everywhere, up to the last bits of the platform's sin, cos and pow.
RandomFlow random_flow(std::uint32_t seed);

}  // namespace seamflow::test
