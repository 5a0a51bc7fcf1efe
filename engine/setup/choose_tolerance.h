#pragma once

#include <optional>
#include <string>

#include "engine/measure/mesh_size.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Whether steps are converged, and why if nobody asked for it.
struct ToleranceChoice {
    /// Empty: steps are sweeps.
    std::optional<double> tolerance;
    /// Empty where the options decide.
    std::string reason;
};

/// The tolerance of the options, if they have one. With Approach::Automatic, and unless another option asks for sweeps,
/// steps are also converged, loosely, where a sweep would drift from the undecomposed step or cost more. So they are
/// where the boundary moves, which sub-meshes can share only in converged steps.
/// @param boundary_moves whether any boundary vertex does.
ToleranceChoice choose_tolerance(const PolygonMesh& mesh, const MeshSize& size, const FlowOptions& options,
                                 bool boundary_moves = false);

}  // namespace seamflow
