#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace seamflow {

/// The bytes of a number in the given order.
template <class Number>
std::array<char, sizeof(Number)> to_bytes(Number value, std::endian order)
{
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if (order != std::endian::native)
        std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

/// The number whose bytes, in the given order, begin at `first`, which need not be aligned.
template <class Number>
Number from_bytes(const char* first, std::endian order)
{
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), first, bytes.size());
    if (order != std::endian::native)
        std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
}

}  // namespace seamflow
