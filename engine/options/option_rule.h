#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

/// Rules on which options go together. They stand in tables, for callers of the library and for programs, which ask for
/// options by other means and have other names for them (see Wording).
namespace seamflow {

/// The options that a caller asks for. A command line may ask for a default value, or name a file with the values of a
/// field.
struct AskedOptions {
    /// Whether an option is asked for.
    /// @param option a field of FlowOptions (see option_table.h), or an option that only the caller has.
    std::function<bool(std::string_view option)> has;
    /// The first option asked for that has one of these concerns (see concern); empty: none has.
    std::function<std::string(unsigned concerns)> first;
};

/// A combination of options that is refused.
template <class Options>
struct OptionRule {
    /// Whether the options have the first half of the combination.
    bool (*applies)(const Options& options, const AskedOptions& asked);
    /// The second half: an option that is asked for and has one of these concerns; 0: the first half alone is refused.
    unsigned against;
    /// The reason, and a remedy. {other} is the option of the second half.
    std::string_view text;
};

/// Completes the text of a rule. @param other the option of its second half, or empty.
using FillText = std::function<std::string(std::string_view text, std::string_view other)>;

/// Replaces {other} alone.
std::string fill_other(std::string_view text, std::string_view other);

/// @throws OptionError with this wording.
[[noreturn]] void refuse(std::string text);

/// Checks rules in their order.
/// @throws OptionError
template <class Options>
void require_none_broken(std::span<const OptionRule<Options>> rules, const Options& options, const AskedOptions& asked,
                         const FillText& fill)
{
    for (const OptionRule<Options>& rule : rules) {
        if (!rule.applies(options, asked))
            continue;
        const std::string other = rule.against == 0 ? "" : asked.first(rule.against);
        if (rule.against == 0 || !other.empty())
            refuse(fill(rule.text, other));
    }
}

}  // namespace seamflow
