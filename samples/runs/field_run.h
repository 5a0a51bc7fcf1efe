#pragma once

#include "engine/ranks/rank_group.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// Runs `smooth` for fields on the surface of INPUT: reads them, lets them diffuse or measures distances, writes OUTPUT
/// with them, and prints what was done.
/// @param run holds the command line. @param ranks that share the steps, or nullptr.
/// @throws as the functions of files, and as diffuse and geodesic_distance.
ExitStatus run_fields(SmoothCommand& command, RunRecord& run, RankGroup* ranks = nullptr);

}  // namespace seamflow
