#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

/// The texts of a program about its options. The first line of an option's description is its line in --help-all;
/// further lines are for the manual page. The footer of a program has its examples: command lines, each with its
/// effect.
namespace seamflow {

/// The whole of --help-all: examples, arguments, and the options by groups, a line each.
std::string help_text(const CLI::App& app);

/// What fits a screen: examples, arguments, and a line for each of some options.
/// @param common their names, in the order in which they are listed; those that the program lacks are left out.
std::string short_help_text(const CLI::App& app, std::span<const std::string_view> common);

/// The manual page of a program, for man: made from the options that --help-all lists, and their full descriptions.
std::string man_page(const CLI::App& app);

/// Completion of the options of a program, and of their values if these are words, for bash; made from the same
/// options. Other values are completed as names of files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, which shows descriptions, too.
std::string zsh_completion(const CLI::App& app);

}  // namespace seamflow
