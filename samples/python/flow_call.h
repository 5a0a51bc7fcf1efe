#pragma once

#include <string>
#include <vector>

#include "engine/options/flow_control.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// The result of a flow of a mesh in memory.
struct FlowResult {
    /// #V by 3.
    Points positions;
    /// Sub-mesh of every face.
    std::vector<Index> labels;
    /// See smooth_report_json.
    std::string report;
    /// See missed_tolerance.
    std::string missed;
};

/// Smooths a mesh in memory as `smooth` smooths one in a file, with the same bits.
/// @param command from parse_flow_options; labels, fixed vertices and weights are in its options.
/// @param mesh need not be valid.
/// @throws the exceptions of mean_curvature_flow; messages about the mesh begin with "mesh: ".
FlowResult call_flow(SmoothCommand command, PolygonMesh mesh, const FlowControl& control);

}  // namespace seamflow
