#pragma once

#include <iosfwd>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/polygon_mesh.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

/// The work around the runs of a command line.
namespace seamflow {

/// Reads into the options the files that the command line names besides the input: labels, fixed vertices, edges,
/// weights of the attachment, and the region.
/// @param left_out ascending: the numbers in the file of the faces that are not in the mesh; they have labels, too.
/// @throws InputError
void read_named_files(SmoothCommand& command, const PolygonMesh& mesh, const std::vector<Index>& left_out);

/// Where messages go: nowhere with --quiet, to standard error where a result takes standard output.
std::ostream& message_stream(const SmoothCommand& command);

/// The status of a complete run. If steps have missed their tolerance, the results are not what was asked for: prints
/// that to standard error.
ExitStatus require_converged(const SmoothCommand& command, const ConvergenceReport& report);

}  // namespace seamflow
