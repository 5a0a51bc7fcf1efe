#pragma once

#include <string>

#include "engine/measure/flow_report.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

/// The work around the runs of a command line.
namespace seamflow {

/// "the tolerance 1e-08 was missed in 2 steps"; empty if the user has requested no tolerance or no step has failed.
/// Those fail that missed it, or, if the user has limited the iterations, those that stagnated.
std::string missed_tolerance(const SmoothRequest& request, const ConvergenceReport& report);

/// The status of a complete run. If steps have missed their tolerance, the results are not what was asked for: prints
/// that to standard error.
ExitStatus require_converged(const SmoothCommand& command, const ConvergenceReport& report);

}  // namespace seamflow
