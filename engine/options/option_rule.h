#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

/// Rules on which options go together. They stand in tables, for callers of the library and for programs, which ask for
/// options by other means and have other names for them (see Wording).
namespace seamflow {

/// Which options a caller asks for. A command line may name the default, or a file with what a field is to hold.
struct AskedOptions {
    /// @param option a field of FlowOptions (see option_table.h), or an option that only the caller has.
    std::function<bool(std::string_view option)> has;
    /// The first that has one of these concerns; empty: none.
    std::function<std::string(unsigned concerns)> first;
};

/// Something that options rule out.
template <class Options>
struct OptionRule {
    /// Whether the rule is about these options.
    bool (*applies)(const Options& options, const AskedOptions& asked);
    /// Then options with one of these concerns are refused; 0: then they are refused anyway.
    unsigned against;
    /// Why, and what to do. {other} is the option that is refused.
    std::string_view text;
};

/// Completes the text of a rule. @param other the option that is refused, or empty.
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
