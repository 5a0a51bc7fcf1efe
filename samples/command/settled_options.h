#pragma once

#include "samples/command/command_line.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// Completes a command whose options have been parsed: takes from a preset the values that no option gives, and
/// determines how to take steps if options imply it.
/// @param app the options, to find which were given.
/// @throws OptionError for options that contradict each other, and for those that would have no effect.
void settle(const CLI::App& app, SmoothCommand& command);

}  // namespace seamflow
