#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "engine/options/option_traits.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// Adds the options of `smooth`: those of a flow (see option_table.h), and its own. They take effect in the order in
/// which they are added, whatever the order on the command line; --help lists them by groups (see command_help.h).
void add_options(CLI::App& app, SmoothCommand& command);

/// All of them, in the order in which they are added.
std::span<const OptionTraits> smooth_options();

/// Those of them that were given.
std::vector<OptionTraits> given_options(const CLI::App& app);

/// Three command lines that show what `smooth` is for, as --help prints them.
std::string smooth_examples();

}  // namespace seamflow
