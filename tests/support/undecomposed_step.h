#pragma once

#include <optional>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow::test {

/// A backward Euler step of a whole mesh, by Gaussian elimination of a dense matrix.
struct UndecomposedStep {
    /// #V by 3.
    Points positions;
    /// How far rounding may carry another way to assemble and solve the same equations, in units of length: a hundred
    /// times what a change of the last bits of the input does.
    double rounding = 0.0;
    /// ‖A‖∞ ‖A⁻¹‖∞ of the equations: by how much the distance to the solution may exceed the residual, relatively.
    double condition = 1.0;
};

/// @param from positions before the step, #V by 3. Who may move depends on `mesh` as it was at the beginning.
/// @returns empty if more than 150 vertices move, or the equations are as good as singular.
std::optional<UndecomposedStep> undecomposed_step(const PolygonMesh& mesh, const FlowOptions& options,
                                                  const Points& from);

/// Changes the last two bits of all coordinates.
void perturb(Points& positions, RandomNumbers& random);

}  // namespace seamflow::test
