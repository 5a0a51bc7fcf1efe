#pragma once

#include "samples/command/command_line.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// Completes a command whose options have been parsed: takes from a preset what no option says, and finds out how steps
/// are to be taken where options speak of it.
/// @param app the options, to tell which were given.
/// @throws OptionError for options that contradict each other, and for such as would have no effect.
void settle(const CLI::App& app, SmoothCommand& command);

}  // namespace seamflow
