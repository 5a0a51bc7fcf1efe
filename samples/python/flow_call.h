#pragma once

#include <string>
#include <vector>

#include "engine/options/flow_control.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// What a flow of a mesh in memory gives back.
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

/// Does to a mesh in memory what `smooth` does to one in a file, with the same bits.
/// @param command from parse_flow_options; labels, fixed vertices and weights are in its options.
/// @param mesh need not be valid.
/// @throws what mean_curvature_flow throws; what is wrong with the mesh begins with "mesh: ".
FlowResult call_flow(SmoothCommand command, PolygonMesh mesh, const FlowControl& control);

}  // namespace seamflow
