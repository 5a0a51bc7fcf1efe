#pragma once

#include <optional>

#include "samples/process/exit_status.h"

namespace seamflow {

/// Refuses to be one of several processes that a launcher of MPI programs has started: each would do the same work and
/// write the same file. The first of them says so on standard error, the others end without a word.
/// @param program its name, for the message.
/// @returns nothing to go on, or how to end.
std::optional<ExitStatus> refuse_several_processes(const char* program);

}  // namespace seamflow
