#pragma once

#include <cstdint>
#include <optional>

#include "engine/distributed/files/shared_mesh_file.h"
#include "samples/command/parse_smooth_command.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// The command line of `smooth-distributed`: that of `smooth`, without options unsupported for a mesh in parts.
struct DistributedCommand {
    SmoothCommand flow;
    FileSharing sharing;
};

/// Parses the command line; on rank 0 also checks that the results can be written to the given paths.
/// @returns, throws as parse_smooth_command.
std::optional<ExitStatus> parse_distributed_command(int argc, char** argv, int rank, DistributedCommand& command);

}  // namespace seamflow
