#pragma once

#include <cmath>

namespace seamflow {

/// The largest power of two that is not above a positive number: what is divided by it loses no bit. 1 for numbers that
/// are not positive, not finite, or so small that this power has no inverse.
inline double power_of_two_near(double number)
{
    return number > 0x1p-1000 && std::isfinite(number) ? std::ldexp(1.0, std::ilogb(number)) : 1.0;
}

}  // namespace seamflow
