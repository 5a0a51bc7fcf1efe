#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "partition/vector_area.h"
#include "samples/meshes/random_numbers.h"

/// What training draws at random.
namespace seamflow {

/// Bits that depend on all bits of both, as MurmurHash3 does at its end (Appleby, 2008).
inline std::uint32_t mixed_bits(std::uint32_t one, std::uint32_t other)
{
    std::uint32_t bits = one * 0x9e3779b9U + other;
    bits = (bits ^ bits >> 16U) * 0x85ebca6bU;
    bits = (bits ^ bits >> 13U) * 0xc2b2ae35U;
    return bits ^ bits >> 16U;
}

/// In [least, most).
inline double between(RandomNumbers& random, double least, double most)
{
    return least + (most - least) * random.unit();
}

/// least to most.
inline int whole_between(RandomNumbers& random, int least, int most)
{
    return least + random.below(most - least + 1);
}

/// Evenly distributed by its logarithm.
inline double scale_between(RandomNumbers& random, double least, double most)
{
    return std::exp(between(random, std::log(least), std::log(most)));
}

/// True with this probability.
inline bool chance(RandomNumbers& random, double probability)
{
    return random.unit() < probability;
}

/// Normally distributed, with variance 1 (Box, Muller, 1958).
inline double normal_number(RandomNumbers& random)
{
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.unit()));
    return radius * std::cos(2.0 * std::numbers::pi * random.unit());
}

/// Three such numbers.
inline Point normal_vector(RandomNumbers& random)
{
    Point vector;
    for (double& coordinate : vector)
        coordinate = normal_number(random);
    return vector;
}

/// Of length 1, evenly distributed.
inline Point random_direction(RandomNumbers& random)
{
    return normal_vector(random).normalized();
}

}  // namespace seamflow
