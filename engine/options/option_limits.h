#pragma once

#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "engine/options/motion_options.h"
#include "engine/options/option_traits.h"
#include "partition/errors.h"

namespace seamflow {

/// Checks a number, a length or an optional value against the limits of its option. An empty value is not checked.
/// @throws OptionError naming the option, its value and its limits.
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

inline void require_within(const OptionTraits& row, LengthOnMesh length)
{
    require_within(row, length.value);
}

inline void require_within(const OptionTraits& row, const MotionBound& bound)
{
    for (const LengthOnMesh& length : bound.lengths)
        require_within(row, length);
}

template <class Value>
void require_within(const OptionTraits& row, const std::optional<Value>& value)
{
    if (value)
        require_within(row, *value);
}

}  // namespace seamflow
