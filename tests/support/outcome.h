#pragma once

#include <string>
#include <vector>

#include "engine/state/flow_state.h"
#include "samples/options/smooth_surface.h"

namespace seamflow::test {

/// What came of a flow.
struct Outcome {
    /// Before it, and after each of its steps.
    std::vector<Points> states;
    std::vector<FlowState> captured;
    /// When all was over, one way or the other.
    Points end;
    SmoothReport report;
    /// OptionError and so on with the message; empty: it succeeded.
    std::string refusal;
    std::string message;
};

/// Runs a flow on a copy of the mesh; what it may throw is noted, other exceptions go through.
/// @param is_captured whether to keep the states to resume from.
Outcome outcome_of(PolygonMesh mesh, const AllOptions& options, const FlowControl& control = {},
                   bool is_captured = false);

}  // namespace seamflow::test
