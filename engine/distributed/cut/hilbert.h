#pragma once

#include <array>
#include <cstdint>

namespace seamflow {

/// The bits of a coordinate of hilbert_code.
inline constexpr int hilbert_bits = 21;

/// The place of a cell along Hilbert's curve through a cube of 2²¹ cells a side: cells that follow each other are
/// neighbours. Skilling, Programming the Hilbert curve, AIP Conference Proceedings 707, 2004.
/// @param cell its coordinates, each below 2²¹. @returns less than 2⁶³.
std::uint64_t hilbert_code(std::array<std::uint32_t, 3> cell);

}  // namespace seamflow
