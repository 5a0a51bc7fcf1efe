#pragma once

#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// Smooths the surface that several files make up, one file at a time: `smooth` with --out-dir. Files are numbered by
/// their names. Positions between steps are in a folder of --out-dir, from which the same command resumes; it is
/// removed at the end.
/// @param command with its tiles.
/// @returns how the program ends.
/// @throws InputError, OptionError, ComputationError, OutputError naming the file.
ExitStatus smooth_tiles(const SmoothCommand& command);

}  // namespace seamflow
