#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "partition/formats/ply_header.h"

/// The ranges of the types of numbers in a PLY file.
namespace seamflow {

/// The number that a property of this type stores for the value of a field: whole numbers are rounded to the nearest,
/// and clamped to the range of the type.
template <class Number>
Number stored_as(double number)
{
    if constexpr (std::is_floating_point_v<Number>) {
        return static_cast<Number>(number);
    } else {
        using Limits = std::numeric_limits<Number>;
        const double nearest = std::round(number);
        if (nearest >= static_cast<double>(Limits::max()))
            return Limits::max();
        return nearest > static_cast<double>(Limits::lowest()) ? static_cast<Number>(nearest) : Limits::lowest();
    }
}

/// Whether the range of the type includes all numbers, rounded if the type is whole. NaN is ignored.
bool reaches(PlyType type, const auto& numbers)
{
    return with_type(type, [&numbers](auto zero) {
        using Limits = std::numeric_limits<decltype(zero)>;
        return std::none_of(numbers.begin(), numbers.end(), [](double number) {
            const double nearest = Limits::is_integer ? std::round(number) : number;
            return nearest < static_cast<double>(Limits::lowest()) || nearest > static_cast<double>(Limits::max());
        });
    });
}

}  // namespace seamflow
