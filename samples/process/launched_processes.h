#pragma once

#include <optional>

#include "samples/process/exit_status.h"

namespace seamflow {

/// Refuses to run as one of several processes that an MPI launcher has started: each would do the same work and write
/// the same file. The first of them reports this on standard error, the others end silently.
/// @param program its name, for the message.
/// @returns empty to continue, else how to end.
std::optional<ExitStatus> refuse_several_processes(const char* program);

}  // namespace seamflow
