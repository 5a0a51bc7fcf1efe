#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "partition/mixed_bits.h"
#include "partition/vector_area.h"

namespace seamflow {

/// A pseudorandom number for a position, so that choices do not depend on the order of vertices. It does not change if
/// all coordinates are multiplied by a power of two.
/// @param round with another number, other pseudorandom numbers result.
inline std::uint64_t random_number_of(const Point& position, std::uint64_t round)
{
    std::uint64_t x = mixed(round + 1);
    for (const double coordinate : position) {
        int exponent = 0;
        x = mixed(x + std::bit_cast<std::uint64_t>(std::frexp(coordinate, &exponent)));
    }
    return x;
}

}  // namespace seamflow
