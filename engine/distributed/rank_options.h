#pragma once

#include "engine/distributed/parts/mesh_part.h"
#include "engine/options/flow_options.h"

/// Options of flows on ranks.
namespace seamflow {

/// @throws OptionError for unsupported options.
void require_for_ranks(const FlowOptions& options);

/// The options with the tolerance of converged steps, if steps are converged, and the weights and strengths of the
/// part.
FlowOptions completed(const FlowOptions& options, const MeshPart& part);

}  // namespace seamflow
