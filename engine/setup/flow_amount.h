#pragma once

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// FlowOptions::time_step, or the time step for FlowOptions::radius, in length².
/// @throws as time_step_of.
double time_step_of(const FlowOptions& options, const PolygonMesh& mesh);

/// FlowOptions::uniform_edge; if Laplacian::Uniform needs it and it is 0, the mean edge length; 1 if no edge has a
/// length.
/// @throws InputError for a mesh that is not valid.
double uniform_edge_of(const FlowOptions& options, const PolygonMesh& mesh);

/// The options with the time step, and with the edge of uniform weights, that they have on a mesh.
/// @throws as time_step_of and uniform_edge_of.
FlowOptions with_amount_on(const FlowOptions& options, const PolygonMesh& mesh);

}  // namespace seamflow
