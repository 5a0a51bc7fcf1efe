#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/measure/displacement_meter.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "engine/setup/flow_plan.h"
#include "engine/state/flow_state.h"
#include "engine/surface/surface.h"
#include "engine/tasks/progress.h"

namespace seamflow {

/// A flow before its first step: all decisions about it, and the measurements that they are based on.
struct PreparedFlow {
    Surface surface;
    /// The given options, resolved. Labels are those of the flowing faces.
    FlowOptions options;
    /// Checksum of the mesh and the given options, by which a checkpoint is recognised. 0 if it is not needed.
    std::uint64_t identity = 0;
    /// The condition under which vertices at junctions would move: the result of need_of_junctions in
    /// automatic_choices.h.
    std::string_view need_of_junctions;
    FlowPlan plan = {};
    /// #V: ‖ΔV⁰‖, in 1/length; empty if it is not needed per vertex.
    std::vector<double> curvature = {};
    /// Refers to the topology; empty without ReportOptions::measures.
    std::optional<DisplacementMeter> meter = {};
};

/// Checks a mesh and decides how it flows: which faces and vertices take part, whether steps are converged, which
/// sub-meshes there are.
/// @param mesh must outlive the result; vertices along seams are joined, faces that repeat others are left out.
/// @param is_observed whether an observer may ask for the flow's state.
/// @param control with the state that the flow is to resume from, and whether ranks share its steps.
/// @throws InputError for a mesh, labels or a state that cannot be used; OptionError; ComputationError for a failure of
///         METIS; Cancelled.
std::unique_ptr<PreparedFlow> prepare(PolygonMesh& mesh, FlowOptions options, bool is_observed,
                                      const FlowControl& control, Progress& progress);

/// Adds the decisions and measurements to the report.
void report_to(const PreparedFlow& prepared, FlowReport& report);

}  // namespace seamflow
