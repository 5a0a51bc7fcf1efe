#include "samples/command/command_line.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/io/input_position.h"
#include "partition/version.h"
#include "samples/command/command_help.h"
#include "samples/process/exit_status.h"

namespace seamflow {

namespace {

/// Texts that the build requests for installation.
std::optional<std::string> text_about(const CLI::App& app, std::string_view asked)
{
    if (asked == "--help-man")
        return man_page(app);
    if (asked == "--help-bash")
        return bash_completion(app);
    return asked == "--help-zsh" ? std::optional(zsh_completion(app)) : std::nullopt;
}

}  // namespace

std::string about_licence()
{
    return gpl_parts().empty()
               ? "Under the MIT licence; the libraries that it is linked with are free for any use, too."
               : fmt::format("Its sources are under the MIT licence. This binary uses {}, and is under "
                             "the GPL-3 as a whole.",
                             gpl_parts());
}

CheckpointPeriod parse_checkpoint_period(std::string_view text)
{
    constexpr std::array<std::pair<std::string_view, double>, 3> units{{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}}};
    const std::string_view unit = text.substr(text.find_last_of("0123456789.") + 1);
    const std::string_view number = text.substr(0, text.size() - unit.size());
    try {
        if (unit.empty())
            return {.steps = static_cast<int>(parse_integer(number, 1, std::numeric_limits<int>::max()))};
        for (const auto& [name, seconds] : units)
            if (unit == name)
                return {.seconds = seconds * parse_real(number, {0.0, 1e9})};
    } catch (const OptionError&) {
    }
    throw OptionError(
        fmt::format("\"{}\" is neither a number of steps from 1 nor a time: give one with s, min or h", text));
}

namespace {

/// The number of letters to insert, remove or replace to turn one word into the other (Levenshtein, 1966).
std::size_t edits_between(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t k = 0; k < b.size(); ++k) {
            const std::size_t exchanged = diagonal + (a[i] == b[k] ? 0 : 1);
            diagonal = row[k + 1];
            row[k + 1] = std::min({row[k] + 1, row[k + 1] + 1, exchanged});
        }
    }
    return row.back();
}

/// On the first argument that the program does not know; empty if there is none.
std::string complaint_of_surplus(const CLI::App& app)
{
    const std::vector<std::string> left = app.remaining();
    const auto option = std::ranges::find_if(left, [](const std::string& word) { return word.starts_with("--"); });
    if (left.empty())
        return {};
    if (option == left.end())
        return fmt::format("{} is one argument too many", in_quotes(left.front())) +
               (app.get_option_no_throw("--out-dir") != nullptr
                    ? ": meshes that are tiles of one surface need --out-dir, for their results"
                    : "");
    const std::string name = option->substr(0, option->find('='));
    std::string nearest;
    std::size_t fewest = std::max<std::size_t>(name.size() / 3, 2);
    // Except for options that exist to be refused.
    for (const CLI::Option* const known :
         app.get_options([](const CLI::Option* one) { return !one->get_group().empty(); }))
        for (const std::string& word : known->get_lnames())
            if (const std::size_t edits = edits_between(name, "--" + word); edits <= fewest) {
                fewest = edits - (edits > 0 ? 1 : 0);
                nearest = "--" + word;
            }
    return fmt::format("there is no option {}{}", name, nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

}  // namespace

CLI::Option* add_reader(CLI::App& app, const std::string& names, const TextReader& reader,
                        const std::string& description)
{
    const auto store = [names, store = reader.store](const std::string& text) {
        try {
            store(text);
        } catch (const OptionError& error) {
            throw CLI::ValidationError(names, error.what());
        }
    };
    if (reader.type.empty())
        return app.add_flag_callback(
            names, [store] { store(""); }, description);
    return app.add_option_function<std::string>(names, store, description)->type_name(reader.type);
}

std::optional<ExitStatus> parse_command_line(CLI::App& app, int argc, char** argv,
                                             std::span<const std::string_view> common)
{
    app.option_defaults()->group("Options");
    app.set_version_flag("--version", fmt::format("seamflow {}\n{}", version, about_licence()));
    app.set_help_all_flag("--help-all", "List all options and exit");
    app.formatter_fn([common](const CLI::App* described, const std::string&, CLI::AppFormatMode mode) {
        return common.empty() || mode == CLI::AppFormatMode::All ? help_text(*described)
                                                                 : short_help_text(*described, common);
    });
    if (const auto text = argc == 2 ? text_about(app, argv[1]) : std::nullopt) {
        std::cout << *text;
        return ExitStatus::Success;
    }
    try {
        app.parse(argc, argv);
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return app.exit(error) == 0 ? ExitStatus::Success : ExitStatus::WrongUsage;
        const std::string surplus = complaint_of_surplus(app);
        say_error(app.get_name(), (surplus.empty() ? error.what() : surplus) + " (--help-all lists all options)");
        return ExitStatus::WrongUsage;
    }
}

}  // namespace seamflow
