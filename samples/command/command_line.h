#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "engine/options/flow_options.h"
#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "samples/files/checkpoints.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// Every finite number above 0.
Limits positive();

/// Reads the whole of `text` as a finite decimal number ("0.05", "1e-3"; not "0.05x", "nan", "inf" or "").
/// @throws OptionError saying what was expected.
double parse_real(std::string_view text, const Limits& limits);

/// As above, for a whole number.
long long parse_integer(std::string_view text, long long least, long long most);

/// Reads a number of bytes, at least 1: a number, then nothing, K, M, G or T (powers of 1000; KB and so on are the
/// same) or KiB, MiB, GiB or TiB (powers of 1024): "500000000", "500M", "1.5GiB". Fractions of a byte are cut off.
/// @throws OptionError saying what was expected.
std::size_t parse_bytes(std::string_view text);

/// Reads a positive length: "0.5" in units of length, "2%" of the diagonal.
/// @throws OptionError saying what was expected.
LengthOnMesh parse_length(std::string_view text);

/// Reads a number of steps, at least 1 ("10"), or a time ("90s", "1.5min", "2h").
/// @throws OptionError saying what was expected.
CheckpointPeriod parse_checkpoint_period(std::string_view text);

/// "x", "y", "z", "normal", or a vector: "0,0.5,1". @throws OptionError for anything else.
MotionDirection parse_direction(std::string_view text);

/// Adds an option whose text `parse` turns into the target's value; an OptionError that it throws gets the name of the
/// option.
template <class Target, class Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& names, Target& target, Parse parse, const std::string& type,
                        const std::string& description)
{
    const auto store = [&target, parse, names](const std::string& text) {
        try {
            target = parse(text);
        } catch (const OptionError& error) {
            throw CLI::ValidationError(names, error.what());
        }
    };
    return app.add_option_function<std::string>(names, store, description)->type_name(type);
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
    const auto parse = [least](const std::string& text) {
        return static_cast<int>(parse_integer(text, least, std::numeric_limits<int>::max()));
    };
    return add_parsed(app, names, target, parse, "INTEGER", description);
}

/// Adds an option that takes one of several words and stores what the word stands for in `target`.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Value& target,
                        const std::vector<std::pair<std::string, Value>>& choices, const std::string& description)
{
    std::string words;
    for (const auto& choice : choices)
        words += (words.empty() ? "" : "|") + choice.first;
    const auto store = [&target, choices, names, words](const std::string& word) {
        for (const auto& [name, value] : choices)
            if (name == word) {
                target = value;
                return;
            }
        throw CLI::ValidationError(names, "\"" + word + "\" is not one of " + words);
    };
    return app.add_option_function<std::string>(names, store, description)->type_name(words);
}

/// As above, for an option of a flow.
template <class Option>
CLI::Option* add_choice(CLI::App& app, const std::string& names, Option& target, const std::string& description)
{
    const auto& list = OptionNames<Option>::list;
    return add_choice(app, names, target, std::vector<std::pair<std::string, Option>>(std::begin(list), std::end(list)),
                      description);
}

/// Under which licence this binary is, and why: a sentence or two.
std::string about_licence();

/// Parses the command line.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
std::optional<ExitStatus> parse_command_line(CLI::App& app, int argc, char** argv);

}  // namespace seamflow
