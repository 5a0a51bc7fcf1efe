#include "samples/options/option_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

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

/// @param what the rest of a sentence on the text: "is not …".
[[noreturn]] void refuse_text(std::string_view text, std::string_view what)
{
    throw OptionError(fmt::format("\"{}\" {}", text, what));
}

/// The parts of "X,Y,Z"; nothing for a text without two commas.
std::optional<std::array<std::string_view, 3>> split_in_three(std::string_view text)
{
    const std::size_t first = text.find(',');
    const std::size_t second = first != std::string_view::npos ? text.find(',', first + 1) : first;
    if (second == std::string_view::npos)
        return std::nullopt;
    return std::array{text.substr(0, first), text.substr(first + 1, second - first - 1), text.substr(second + 1)};
}

/// Reads "X,Y,Z"; nothing for another text.
std::optional<Point> parse_three(std::string_view text, const Limits& limits)
{
    const auto parts = split_in_three(text);
    if (!parts)
        return std::nullopt;
    try {
        return Point(parse_real((*parts)[0], limits), parse_real((*parts)[1], limits), parse_real((*parts)[2], limits));
    } catch (const OptionError&) {
        return std::nullopt;
    }
}

}  // namespace

Limits positive()
{
    return {.least = 0.0, .above_least = true};
}

double parse_real(std::string_view text, const Limits& limits)
{
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && rest == end && std::isfinite(value) && limits.hold(value))
        return value;
    refuse_text(text, "is not " + described(limits));
}

long long parse_integer(std::string_view text, long long least, long long most)
{
    long long value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && rest == end && value >= least && value <= most)
        return value;
    refuse_text(text, fmt::format("is not a whole number from {} to {}", least, most));
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
        refuse_text(text, "is not a number of bytes from 1 to 2^60: give one, alone or with K, M, G, T (powers of "
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
        refuse_text(text, "is neither a positive length (0.5) nor a part of the bounding box's diagonal (2%)");
    }
}

MotionBound parse_bound(std::string_view text)
{
    try {
        const auto parts = split_in_three(text);
        return parts ? MotionBound(parse_length((*parts)[0]), parse_length((*parts)[1]), parse_length((*parts)[2]))
                     : MotionBound(parse_length(text));
    } catch (const OptionError&) {
        refuse_text(text,
                    "is neither a positive length (0.5), nor a part of the bounding box's diagonal (2%), nor three "
                    "of these, along x, y and z (1,1,0.2)");
    }
}

Rounding parse_rounding(std::string_view text)
{
    if (text == "never")
        return {.kind = Rounding::Kind::Never};
    constexpr Limits limits{0.0, std::numeric_limits<double>::max()};
    std::optional<Point> steps = parse_three(text, limits);
    if (text.find(',') == std::string_view::npos) {
        try {
            steps = Point::Constant(parse_real(text, limits));
        } catch (const OptionError&) {
        }
    }
    if (!steps || steps->isZero(0.0))
        refuse_text(text, "is neither a step above 0, nor three like 0.5,0.5,3, nor never");
    return {.kind = Rounding::Kind::Given, .steps = *steps};
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
    if (const std::optional<Point> vector = parse_three(text, {}); vector && vector->norm() > 0.0) {
        direction.vector = *vector;
        return direction;
    }
    refuse_text(text, "is neither x, y, z nor normal, nor a vector like 0,0.5,1");
}

const NamedValues<Laplacian>& laplacian_words()
{
    static const auto words = [] {
        NamedValues<Laplacian> named;
        for (const LaplacianTraits& traits : all_laplacian_traits())
            named.emplace_back(traits.name, traits.laplacian);
        return named;
    }();
    return words;
}

}  // namespace seamflow
