#pragma once

#include <cstdint>

namespace seamflow {

/// Mixes the bits of a number: every bit of the result depends on all bits of the number, and different numbers have
/// different results. The mixing function of SplitMix64 (Steele, Lea and Flood, Fast Splittable Pseudorandom Number
/// Generators, 2014). 0 stays 0.
inline std::uint64_t mixed(std::uint64_t bits)
{
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    return bits ^ (bits >> 31U);
}

}  // namespace seamflow
