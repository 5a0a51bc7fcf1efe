#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "engine/options/flow_options.h"

/// Which options go together. Each rule stands in one table, for callers of the library and for programs, which ask for
/// options by other means and have other names for them (see Wording).
namespace seamflow {

/// Which options a caller asks for. A command line may name the default, or a file with what a field is to hold.
struct AskedOptions {
    /// @param option a field of FlowOptions (see option_table.h), or an option that only the caller has.
    std::function<bool(std::string_view option)> has;
    /// The first that has one of these concerns; empty: none.
    std::function<std::string(unsigned concerns)> first;
};

/// Those that are not as by default.
AskedOptions changed_options(const FlowOptions& options);

/// Something that options rule out.
template <class Options>
struct OptionRule {
    /// Whether the rule is about these options.
    bool (*applies)(const Options& options, const AskedOptions& asked);
    /// Then options with one of these concerns are refused; 0: then they are refused anyway.
    unsigned against;
    /// Why, and what to do. {other} is the option that is refused; {laplacian}, {approach}, {conditions} and
    /// {factorisation} are those of FlowOptions, {symmetric} Laplacians that are, {further} what is not plain mean
    /// curvature flow, {whole} what takes the whole mesh without equations.
    std::string_view text;
};

/// @param other an option, or empty. @throws OptionError with the text of a rule.
[[noreturn]] void refuse(std::string_view text, const FlowOptions& options, std::string_view other);

/// Checks rules in their order.
/// @param options the values that texts name.
/// @throws OptionError
template <class Options>
void require_none_broken(std::span<const OptionRule<Options>> rules, const Options& of_rules,
                         const FlowOptions& options, const AskedOptions& asked)
{
    for (const OptionRule<Options>& rule : rules) {
        if (!rule.applies(of_rules, asked))
            continue;
        const std::string other = rule.against == 0 ? "" : asked.first(rule.against);
        if (rule.against == 0 || !other.empty())
            refuse(rule.text, options, other);
    }
}

/// Checks which options of a flow go together.
/// @throws OptionError
void require_compatible(const FlowOptions& options, const AskedOptions& asked);

}  // namespace seamflow
