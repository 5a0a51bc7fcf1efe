#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// The texts of a program about its options. The first line of an option's description is its line in --help; further
/// lines are for the manual page. The footer of a program has its examples: command lines, each with its effect.
namespace seamflow {

/// The groups of options, in the order in which --help lists them; options of no group come last.
namespace option_group {

inline constexpr const char* amount = "How much is smoothed";
inline constexpr const char* kind = "What kind of mesh";
inline constexpr const char* kept = "What stays";
inline constexpr const char* fields = "Fields on the surface";
inline constexpr const char* written = "What is written";
inline constexpr const char* accuracy = "Accuracy";
inline constexpr const char* sub_meshes = "Sub-meshes";
inline constexpr const char* machine = "Machine";

}  // namespace option_group

/// The options that --help lists, in its order.
std::vector<const CLI::Option*> options_by_groups(const CLI::App& app);

/// The whole of --help: examples, arguments, and the options by groups, a line each.
std::string help_text(const CLI::App& app);

/// The manual page of a program, for man: made from the options that --help lists, and their full descriptions.
std::string man_page(const CLI::App& app);

/// Completion of the options of a program, and of their values if these are words, for bash; made from the same
/// options. Other values are completed as names of files.
std::string bash_completion(const CLI::App& app);

/// The same for zsh, which shows descriptions, too.
std::string zsh_completion(const CLI::App& app);

}  // namespace seamflow
