#include "samples/command/command_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iostream>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "partition/errors.h"
#include "partition/io/input_position.h"
#include "partition/version.h"
#include "samples/command/command_help.h"

namespace seamflow {

namespace {

std::string described(const Limits& limits)
{
    std::string text = "a finite number";
    if (std::isfinite(limits.least))
        text += fmt::format(" {} {:.6g}", limits.above_least ? "above" : "from", limits.least);
    if (std::isfinite(limits.most))
        text += fmt::format(" {} {:.6g}",
                            limits.below_most             ? "and below"
                            : std::isfinite(limits.least) ? "to"
                                                          : "up to",
                            limits.most);
    return text;
}

/// The factor of a suffix; nothing if it is unknown.
std::optional<double> unit_of(std::string_view suffix)
{
    constexpr std::string_view letters = "KMGT";
    if (suffix.empty())
        return 1.0;
    const auto power = letters.find(suffix.front());
    const std::string_view rest = suffix.substr(1);
    if (power == std::string_view::npos || !(rest.empty() || rest == "B" || rest == "iB"))
        return std::nullopt;
    return std::pow(rest == "iB" ? 1024.0 : 1000.0, static_cast<double>(power + 1));
}

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

Limits positive()
{
    return {.least = 0.0, .above_least = true};
}

namespace {

/// @param what the rest of a sentence on the text: "is not …".
[[noreturn]] void refuse(std::string_view text, std::string_view what)
{
    throw OptionError(fmt::format("\"{}\" {}", text, what));
}

}  // namespace

double parse_real(std::string_view text, const Limits& limits)
{
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && rest == end && std::isfinite(value) && limits.hold(value))
        return value;
    refuse(text, "is not " + described(limits));
}

long long parse_integer(std::string_view text, long long least, long long most)
{
    long long value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && rest == end && value >= least && value <= most)
        return value;
    refuse(text, fmt::format("is not a whole number from {} to {}", least, most));
}

std::size_t parse_bytes(std::string_view text)
{
    constexpr double most = 0x1p60;
    const std::size_t n_digits = text.find_last_of("0123456789.") + 1;
    double value = 0.0;
    const char* const end = text.data() + n_digits;
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    const std::optional<double> unit = unit_of(text.substr(n_digits));
    const bool number = error == std::errc() && rest == end && unit;
    const double bytes = number ? value * *unit : 0.0;
    if (!(bytes >= 1.0 && bytes <= most))
        refuse(text, "is not a number of bytes from 1 to 2^60: give one, alone or with K, M, G, T (powers of "
                     "1000) or KiB, MiB, GiB, TiB (of 1024)");
    return static_cast<std::size_t>(bytes);
}

LengthOnMesh parse_length(std::string_view text)
{
    const bool of_diagonal = text.ends_with('%');
    try {
        if (!of_diagonal)
            return {parse_real(text, positive()), false};
        return {parse_real(text.substr(0, text.size() - 1), positive()) / 100.0, true};
    } catch (const OptionError&) {
        refuse(text, "is neither a positive length (0.5) nor a part of the bounding box's diagonal (2%)");
    }
}

MotionDirection parse_direction(std::string_view text)
{
    if (text == "normal")
        return {.kind = MotionDirection::Kind::Normal};
    MotionDirection direction{.kind = MotionDirection::Kind::Vector};
    constexpr std::string_view axes = "xyz";
    if (const std::size_t axis = axes.find(text); text.size() == 1 && axis != std::string_view::npos) {
        direction.vector[static_cast<Eigen::Index>(axis)] = 1.0;
        return direction;
    }
    const std::size_t first = text.find(',');
    const std::size_t second = first != std::string_view::npos ? text.find(',', first + 1) : first;
    try {
        if (second != std::string_view::npos)
            direction.vector = {parse_real(text.substr(0, first), {}),
                                parse_real(text.substr(first + 1, second - first - 1), {}),
                                parse_real(text.substr(second + 1), {})};
        if (direction.vector.norm() > 0.0)
            return direction;
    } catch (const OptionError&) {
    }
    refuse(text, "is neither x, y, z nor normal, nor a vector like 0,0.5,1");
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
    refuse(text, "is neither a number of steps from 1 nor a time: give one with s, min or h");
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
        return in_quotes(left.front()) + " is one argument too many" +
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

std::optional<ExitStatus> parse_command_line(CLI::App& app, int argc, char** argv)
{
    app.option_defaults()->group("Options");
    app.set_version_flag("--version", fmt::format("seamflow {}\n{}", version, about_licence()));
    app.formatter_fn(
        [](const CLI::App* described, const std::string&, CLI::AppFormatMode) { return help_text(*described); });
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
        std::cerr << app.get_name() << ": " << (surplus.empty() ? error.what() : surplus)
                  << " (--help lists all options)\n";
        return ExitStatus::WrongUsage;
    }
}

}  // namespace seamflow
