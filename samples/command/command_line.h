#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "samples/files/checkpoints.h"
#include "samples/options/option_text.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// Reads a number of steps, at least 1 ("10"), or a time ("90s", "1.5min", "2h").
/// @throws OptionError saying what was expected.
CheckpointPeriod parse_checkpoint_period(std::string_view text);

/// Adds an option; an OptionError of its reader gets the name of the option.
/// @param names "--quiet,-q".
CLI::Option* add_reader(CLI::App& app, const std::string& names, const TextReader& reader,
                        const std::string& description);

/// Adds an option whose text `parse` turns into the target's value.
template <class Target, class Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& names, Target& target, Parse parse, const std::string& type,
                        const std::string& description)
{
    return add_reader(app, names, reader_by(target, parse, type), description);
}

/// Adds an option that takes one number and stores it in `target`, a double that may be empty.
template <class Target>
CLI::Option* add_real(CLI::App& app, const std::string& names, Target& target, const Limits& limits,
                      const std::string& description)
{
    const auto parse = [limits](const std::string& text) { return parse_real(text, limits); };
    return add_parsed(app, names, target, parse, "NUMBER", description);
}

/// As above, for a whole number from `least` to the largest that fits the target.
template <class Target>
CLI::Option* add_integer(CLI::App& app, const std::string& names, Target& target, int least,
                         const std::string& description)
{
    return add_reader(app, names, reader_of(target, {.least = static_cast<double>(least)}), description);
}

/// Adds an option that takes one of several words and stores what the word stands for in `target`.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Value& target, const NamedValues<Value>& words,
                        const std::string& description)
{
    return add_reader(app, names, reader_of_words(target, words), description);
}

/// As above, for an option of a flow.
template <class Option>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Option& target, const std::string& description)
{
    return add_reader(app, names, reader_of(target, {}), description);
}

/// Under which licence this binary is, and why: a sentence or two.
std::string about_licence();

/// Parses the command line.
/// @param common the options that --help lists, if --help-all lists more; empty: both list all.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
std::optional<ExitStatus> parse_command_line(CLI::App& app, int argc, char** argv,
                                             std::span<const std::string_view> common = {});

}  // namespace seamflow
