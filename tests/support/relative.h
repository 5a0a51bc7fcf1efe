#pragma once

#include <doctest/doctest.h>

namespace seamflow::test {

/// What a number is compared with that may differ from `value` by the part `most` of the larger of the two. Bare,
/// doctest::Approx adds 1 to that: of small numbers it accepts any.
/// @param value not 0, of which there is no part: compare an absolute value with a bound there.
inline doctest::Approx relative(double value, double most)
{
    return doctest::Approx(value).epsilon(most).scale(0.0);
}

}  // namespace seamflow::test
