#include "engine/options/valid_options.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/options/option_rules.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

template <class Value>
requires std::is_arithmetic_v<Value>
void require_within(const OptionTraits& row, Value value)
{
    if (row.limits.hold(static_cast<double>(value)))
        return;
    constexpr const char* text =
        std::is_same_v<Value, double> ? "<{}> is {:.17g}, but must be {}" : "<{}> is {}, but must be {}";
    throw OptionError(Wording{fmt::format(fmt::runtime(text), row.field, value, row.limits.text)});
}

void require_within(const OptionTraits& row, LengthOnMesh length)
{
    require_within(row, length.value);
}

template <class Value>
void require_within(const OptionTraits& row, const std::optional<Value>& value)
{
    if (value)
        require_within(row, *value);
}

/// Checks all numbers.
void require_limits(const FlowOptions& options)
{
    for_each_option(options, [&](const auto& row) {
        const bool is_open = row.field == "time_step" && (options.radius || options.denoise);
        if constexpr (requires { require_within(row, *row.value); })
            if (!row.limits.text.empty() && !is_open)
                require_within(row, *row.value);
    });
}

bool is_weight(double weight)
{
    return weight >= 0.0 && std::isfinite(weight);
}

void require_valid_attachment(const MotionOptions& motion)
{
    const auto wrong = std::ranges::find_if_not(motion.attachment_weights, is_weight);
    if (wrong != motion.attachment_weights.end())
        throw InputError(fmt::format("the attachment weight of vertex {} is {:.17g}, but must be at least 0 and finite "
                                     "(1/length²)",
                                     wrong - motion.attachment_weights.begin(), *wrong));
}

void require_valid_strength(const FlowOptions& options)
{
    const std::vector<double>& strength = options.motion.strength;
    const auto wrong = std::ranges::find_if_not(strength, [](double s) { return s >= 0.0 && s <= 1.0; });
    if (wrong != strength.end())
        throw InputError(fmt::format("the strength of vertex {} is {:.17g}, but must be from 0 to 1",
                                     wrong - strength.begin(), *wrong));
}

void require_valid_filter(const FlowOptions& options)
{
    const auto [least, most] = orders_of(options.filter);
    const int order = filter_of(options).order;
    if (order < least || order > most)
        throw OptionError(Wording{fmt::format("<order> is {}, but must be {} to {} with the filter {}", order, least,
                                              most, option_name(options.filter))});
}

}  // namespace

void require_threads(int threads)
{
    require_within(*std::ranges::find(all_options(), "threads", &OptionTraits::field), threads);
}

void require_valid(const FlowOptions& options)
{
    require_limits(options);
    require_valid_attachment(options.motion);
    require_valid_strength(options);
    require_valid_filter(options);
    require_compatible(options, changed_options(options));
    const auto negative =
        std::find_if(options.cut.labels.begin(), options.cut.labels.end(), [](Index label) { return label < 0; });
    if (negative != options.cut.labels.end())
        throw InputError(fmt::format("the label of face {} is {}, but labels must be at least 0",
                                     negative - options.cut.labels.begin(), *negative));
}

}  // namespace seamflow
