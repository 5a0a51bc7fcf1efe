#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace seamflow {

/// Arrays as text that a browser can unpack by itself (DecompressionStream): differences, bytes in planes, a zlib
/// stream (RFC 1950), base64 (RFC 4648).
///
/// Rows of `columns` numbers each are replaced by their differences from the previous row (the first row from 0),
/// modulo 2^16 or 2^32, with the sign in the lowest bit (0, -1, 1, -2, … are 0, 1, 2, 3, …). Column by column, all
/// lowest bytes come first, then all second bytes and so on.
/// @param numbers a multiple of `columns`. @param columns at least 1.
std::string packed(std::span<const std::uint16_t> numbers, std::size_t columns);
std::string packed(std::span<const std::uint32_t> numbers, std::size_t columns);

/// Unchanged bytes as a zlib stream in base64.
std::string packed(std::span<const std::uint8_t> bytes);

}  // namespace seamflow
