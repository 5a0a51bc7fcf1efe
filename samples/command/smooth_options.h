#pragma once

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "samples/command/smooth_command.h"

namespace seamflow {

/// Adds the options of `smooth` about the flow, which Python has as well. They take effect in the order in which they
/// are added, whatever the order on the command line; --help lists them by groups (see command_help.h).
void add_flow_options(CLI::App& app, SmoothCommand& command);

/// Adds INPUT, OUTPUT and the options about further files and printed text.
/// @param every_step gets the pattern of --every-step.
void add_files(CLI::App& app, SmoothCommand& command, std::string& every_step);

/// Three command lines that show what `smooth` is for, as --help prints them.
std::string smooth_examples();

}  // namespace seamflow
