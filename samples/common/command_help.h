#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace seamflow {

/// The manual page of a program, for man: made from the options that --help lists.
std::string man_page(const CLI::App& app);

/// What completes the options of a program, and their values where these are words, on the command line of bash; made
/// from the same options. Where there are no words, bash completes names of files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, which shows descriptions, too.
std::string zsh_completion(const CLI::App& app);

}  // namespace seamflow
