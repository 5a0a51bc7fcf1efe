#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include <CLI/App.hpp>

#include "engine/options/option_rules.h"
#include "engine/options/option_traits.h"
#include "samples/command/smooth_command.h"

namespace seamflow {

/// Adds the options of `smooth`: those of a flow (see option_table.h), and its own. They take effect in the order in
/// which they are added, whatever the order on the command line; --help lists them by groups (see command_help.h).
void add_options(CLI::App& app, SmoothCommand& command);

/// All of them, in the order in which they are added.
std::span<const OptionTraits> smooth_options();

/// The first of these options that was given; empty if none.
std::string first_given(const CLI::App& app, std::initializer_list<std::string_view> names);

/// The same for options with one of these concerns.
std::string first_given(const CLI::App& app, unsigned concerns);

/// Which options were given, or chosen by a preset. Both arguments must outlive the result.
AskedOptions given_options(const CLI::App& app, const SmoothCommand& command);

/// Three command lines that show what `smooth` is for, as --help prints them.
std::string smooth_examples();

}  // namespace seamflow
