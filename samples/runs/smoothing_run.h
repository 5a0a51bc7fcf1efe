#pragma once

#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"
#include "samples/report/run_record.h"

/// What `smooth` and the Python module do alike around a flow.
namespace seamflow {

/// What is known of a run before its mesh is.
RunRecord begin_record(const SmoothCommand& command);

/// Turns what `command` leaves to be taken from the mesh into numbers: an amount that depends on its size or noise, and
/// an attachment; notes them in `run`.
/// @param mesh valid (see require_valid).
/// @throws InputError for a mesh that has no size to measure by, without naming it: "has no size …".
void resolve_amount(SmoothCommand& command, const PolygonMesh& mesh, const Executor& exec, RunRecord& run);

/// A surface that flows by mean curvature shrinks, which surprises those who only wanted it smooth: adds a remark where
/// it has lost much of its volume, or most of its area where it encloses none.
/// @param can_rescale whether the user can ask for that.
void remark_on_loss(const FlowOptions& options, const SurfaceChange& change, std::vector<std::string>& remarks,
                    bool can_rescale = true);

/// Adds a remark where the surface has folded over, or crosses itself where it did not before, with what prevents it.
void remark_on_folds(const FlowOptions& options, const SurfaceChange& change, std::vector<std::string>& remarks);

/// "the tolerance 1e-08 was missed in 2 steps"; empty where no step has failed (see steps_failed).
std::string missed_tolerance(const SmoothCommand& command, const ConvergenceReport& report);

}  // namespace seamflow
