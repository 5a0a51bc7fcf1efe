#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace seamflow {

/// Sentences for users, in which options are marked, so that each caller reads them by its own names: `<radius>`, or
/// `<boundary free>` for an option and a value. A mark has the library's name of the option, which is the name of a
/// field of the options or of a parameter. << stands for a < that marks nothing.
struct Wording {
    std::string text;

    friend bool operator==(const Wording&, const Wording&) = default;
};

/// How a caller writes an option.
/// @param option the library's name. @param value empty: the option alone.
using OptionWriter = std::function<std::string(std::string_view option, std::string_view value)>;

/// The library's own name, and the value after a blank.
std::string option_of_library(std::string_view option, std::string_view value);

/// The text of a wording, with each mark replaced by the caller's name of the option.
std::string sentence(const Wording& wording, const OptionWriter& write = option_of_library);

/// The wording that reads as `text` for every caller: nothing is marked, and each < is doubled.
Wording unmarked(std::string_view text);

/// A message to the user about a result or how it was made: a kind and numbers, for programs, and sentences about them.
struct Remark {
    using Numbers = std::vector<std::pair<std::string, double>>;

    Remark(std::string kind_of_remark, Numbers numbers_of_it, Wording wording_of_it);

    /// A remark of kind "other", without numbers and marks.
    Remark(const std::string& text);

    /// One or two words, like "collapse" or "missed tolerance"; the same kind has the same numbers.
    std::string kind;
    /// The numbers of the message, each with its name, in the order of the message.
    Numbers numbers;
    Wording wording;

    /// The number of this name; nothing if the kind has no such number.
    [[nodiscard]] std::optional<double> number(std::string_view name) const;

    friend bool operator==(const Remark&, const Remark&) = default;
};

/// The text of a remark, with each mark replaced by the caller's name of the option.
inline std::string sentence(const Remark& remark, const OptionWriter& write = option_of_library)
{
    return sentence(remark.wording, write);
}

}  // namespace seamflow
