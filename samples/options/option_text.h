#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/denoise/denoise_options.h"
#include "engine/options/motion_options.h"
#include "engine/options/option_names.h"
#include "engine/options/option_traits.h"
#include "partition/errors.h"
#include "solvers/laplacian/laplacian.h"

/// Options as people write them: each value is a text. Command lines and keywords of Python share them.
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

/// Reads a length, or three with commas between them: along x, y and z. @throws OptionError for another text.
MotionBound parse_bound(std::string_view text);

/// "x", "y", "z", "normal", or a vector: "0,0.5,1". @throws OptionError for anything else.
MotionDirection parse_direction(std::string_view text);

/// "never", one step for x, y and z, or one for each: "0.5,0.5,3". @throws OptionError for anything else.
Rounding parse_rounding(std::string_view text);

/// Words, and what each stands for.
template <class Value>
using NamedValues = std::vector<std::pair<std::string, Value>>;

/// The names of all Laplacians.
const NamedValues<Laplacian>& laplacian_words();

/// "one|other".
template <class Value>
std::string type_of(const NamedValues<Value>& words)
{
    std::string type;
    for (const auto& word : words)
        type += (type.empty() ? "" : "|") + word.first;
    return type;
}

/// @throws OptionError for another word.
template <class Value>
Value parse_word(const std::string& text, const NamedValues<Value>& words)
{
    for (const auto& [word, value] : words)
        if (word == text)
            return value;
    throw OptionError("\"" + text + "\" is not one of " + type_of(words));
}

/// A way to read an option.
struct TextReader {
    /// The placeholder of the value in --help; empty: it takes none, and is true where it is given.
    std::string type;
    /// Stores the value. @throws OptionError saying what was expected.
    std::function<void(const std::string& text)> store;
};

/// A reader for a value that `parse` makes of the text.
template <class Value, class Parse>
TextReader reader_by(Value& value, Parse parse, std::string type)
{
    return {std::move(type), [&value, parse](const std::string& text) { value = parse(text); }};
}

template <class Value>
TextReader reader_of_words(Value& value, const NamedValues<Value>& words)
{
    return reader_by(
        value, [words](const std::string& text) { return parse_word(text, words); }, type_of(words));
}

/// A value that reader_of can read.
template <class Value>
concept IsReadable = std::is_enum_v<Value> || std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string> ||
    std::is_same_v<Value, std::filesystem::path> || requires
{
    std::declval<Value>().has_value();
};

/// The reader of a number within limits, one of several words, a size, a length, a name, a file or a flag.
template <IsReadable Value>
TextReader reader_of(Value& value, const Limits& limits)
{
    const auto parse_whole = [least = limits.least](const std::string& text) {
        return static_cast<int>(parse_integer(text, static_cast<int>(least), std::numeric_limits<int>::max()));
    };
    if constexpr (std::is_same_v<Value, Laplacian>)
        return reader_of_words(value, laplacian_words());
    else if constexpr (std::is_enum_v<Value>)
        return reader_of_words(
            value, NamedValues<Value>(std::begin(OptionNames<Value>::list), std::end(OptionNames<Value>::list)));
    else if constexpr (std::is_same_v<Value, bool>)
        return {"", [&value](const std::string&) { value = true; }};
    else if constexpr (std::is_same_v<Value, std::string>)
        return {"NAME", [&value](const std::string& text) { value = text; }};
    else if constexpr (std::is_same_v<Value, std::filesystem::path>)
        return {"FILE", [&value](const std::string& text) { value = text; }};
    else if constexpr (std::is_same_v<Value, std::optional<std::size_t>>)
        return reader_by(value, parse_bytes, "SIZE");
    else if constexpr (std::is_same_v<Value, std::optional<LengthOnMesh>>)
        return reader_by(value, parse_length, "LENGTH");
    else if constexpr (std::is_same_v<Value, std::optional<MotionBound>>)
        return reader_by(value, parse_bound, "LENGTH|X,Y,Z");
    else if constexpr (std::is_same_v<Value, int> || std::is_same_v<Value, std::optional<int>>)
        return reader_by(value, parse_whole, "INTEGER");
    else
        return reader_by(
            value, [limits](const std::string& text) { return parse_real(text, limits); }, "NUMBER");
}

}  // namespace seamflow
