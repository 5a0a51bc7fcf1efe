#pragma once

#include <span>

#include <CLI/App.hpp>

#include "samples/command/smooth_command.h"

/// The command line of `smooth` for several files that make up one surface: smooth INPUT… --out-dir FOLDER.
namespace seamflow {

/// Whether these are arguments of such a command line.
bool names_tiles(std::span<char* const> arguments);

/// Replaces INPUT and OUTPUT by any number of inputs.
/// @param app with the options of add_files.
void take_tiles(CLI::App& app, SmoothCommand& command);

/// To be called when the command line was parsed: puts the inputs into the order of their names.
/// @throws OptionError for options that need the whole mesh at once, without an amount, for inputs of the same name,
///         and for results that would replace inputs; OutputError if the folder cannot be made.
void require_tiles(SmoothCommand& command);

}  // namespace seamflow
