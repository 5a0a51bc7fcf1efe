#pragma once

#include <iosfwd>

#include "engine/distributed/ranks/transport.h"
#include "samples/command/distributed_command.h"
#include "samples/process/exit_status.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// Runs `smooth-distributed` for fields on the surface of INPUT, as run_fields runs `smooth`. All ranks call this
/// together.
/// @param run holds the command line. @param out where rank 0 prints, unlike the others.
/// @throws as the functions of files, and as diffuse_on_ranks.
ExitStatus run_fields_on_ranks(Transport& ranks, DistributedCommand& command, RunRecord& run, std::ostream& out);

}  // namespace seamflow
