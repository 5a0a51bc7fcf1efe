#pragma once

#include <iosfwd>
#include <vector>

#include "engine/measure/flow_report.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

/// The work around the runs of a command line.
namespace seamflow {

/// The strengths of --region, #V: of a file, or of a property of the input; empty without that option.
std::vector<double> read_region(const SmoothCommand& command, Index n_vertices);

/// Where messages go: nowhere with --quiet, to standard error where a result takes standard output.
std::ostream& message_stream(const SmoothCommand& command);

/// The status of a complete run. If steps have missed their tolerance, the results are not what was asked for: prints
/// that to standard error.
ExitStatus require_converged(const SmoothCommand& command, const ConvergenceReport& report);

}  // namespace seamflow
