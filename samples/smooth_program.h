#pragma once

#include "engine/ranks/rank_group.h"
#include "samples/command/parse_smooth_command.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// What `smooth` does, and `smooth-distributed` on its rank 0: reads, flows and writes.
/// @param ranks that share the steps of the flow; nullptr: there is one process.
/// @throws the errors of errors.h; the report then has their message, too.
ExitStatus run_smooth_program(int argc, char** argv, const SmoothProgram& program = {}, RankGroup* ranks = nullptr);

}  // namespace seamflow
