#pragma once

#include <ostream>

#include "engine/measure/flow_report.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

/// What a run of `smooth` or `smooth-distributed` prints, and how it ends.
namespace seamflow {

/// Where messages go: nowhere with --quiet, to standard error where a result takes standard output.
std::ostream& message_stream(const SmoothCommand& command);

/// The status of a complete run. If steps have missed their tolerance, the results are not what was asked for: prints
/// that to standard error.
ExitStatus require_converged(const SmoothCommand& command, const ConvergenceReport& report);

}  // namespace seamflow
