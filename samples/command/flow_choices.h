#pragma once

#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CLI/App.hpp>

#include "engine/options/flow_options.h"
#include "samples/command/command_line.h"

/// Options of command lines whose values are those of FlowOptions, or like them.
namespace seamflow {

/// The names of all Laplacians.
const std::vector<std::pair<std::string, Laplacian>>& laplacian_choices();

/// A value that add_value can read.
template <class Value>
concept IsReadable = std::is_enum_v<Value> || std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string> ||
    std::is_same_v<Value, std::filesystem::path> || std::is_same_v<Value, std::vector<std::string>> || requires
{
    std::declval<Value>().has_value();
};

/// Adds an option: a number within its limits, one of several words, a size, a length, a name or a flag.
template <IsReadable Value>
CLI::Option* add_value(CLI::App& app, const OptionTraits& of, Value& value)
{
    const std::string name(of.option);
    const std::string text(of.text);
    if constexpr (std::is_same_v<Value, Laplacian>)
        return add_choice(app, name, value, laplacian_choices(), text);
    else if constexpr (std::is_enum_v<Value>)
        return add_choice(app, name, value, text);
    else if constexpr (std::is_same_v<Value, bool>)
        return app.add_flag(name, value, text);
    else if constexpr (std::is_same_v<Value, std::string>)
        return app.add_option(name, value, text)->type_name("NAME");
    else if constexpr (std::is_same_v<Value, std::filesystem::path>)
        return app.add_option(name, value, text)->type_name("FILE");
    else if constexpr (std::is_same_v<Value, std::vector<std::string>>)
        return app.add_option(name, value, text)->delimiter(',')->type_name("NAME,…");
    else if constexpr (std::is_same_v<Value, std::optional<std::size_t>>)
        return add_parsed(app, name, value, parse_bytes, "SIZE", text);
    else if constexpr (std::is_same_v<Value, std::optional<LengthOnMesh>>)
        return add_parsed(app, name, value, parse_length, "LENGTH", text);
    else if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, std::optional<int>>)
        return add_integer(app, name, value, static_cast<int>(of.limits.least), text);
    else
        return add_real(app, name, value, of.limits, text);
}

/// Adds the option of a field of FlowOptions with another description.
/// @param name its name in the table of options, "--steps".
void add_field(CLI::App& app, FlowOptions& options, const std::string& name, const std::string& description);

/// Adds --converge: "auto", "never", or a tolerance below 1, for AccuracyOptions::tolerance and approach.
CLI::Option* add_converge(CLI::App& app, FlowOptions& options, const std::string& description);

}  // namespace seamflow
