#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <zlib.h>

#include "partition/formats/gltf_text.h"

namespace seamflow::test {

/// What packed() has packed, undone as far as the bytes.
inline std::vector<std::uint8_t> inflated(const std::string& base64)
{
    const std::optional<std::string> stream = bytes_of_gltf_base64(base64);
    REQUIRE(stream);
    std::vector<std::uint8_t> bytes(1U << 20U);
    uLongf size = bytes.size();
    REQUIRE(uncompress(bytes.data(), &size, reinterpret_cast<const Bytef*>(stream->data()), stream->size()) == Z_OK);
    bytes.resize(size);
    return bytes;
}

/// All of packed() undone.
template <class Number>
std::vector<Number> unpacked(const std::string& base64, std::size_t columns)
{
    const std::vector<std::uint8_t> bytes = inflated(base64);
    std::vector<Number> numbers(bytes.size() / sizeof(Number));
    const std::size_t rows = numbers.size() / columns;
    for (std::size_t column = 0; column < columns; ++column) {
        Number now = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            Number folded = 0;
            for (std::size_t k = 0; k < sizeof(Number); ++k)
                folded = static_cast<Number>(
                    folded | static_cast<Number>(bytes[(column * sizeof(Number) + k) * rows + row]) << (8 * k));
            const auto half = static_cast<Number>(folded >> 1U);
            now = static_cast<Number>(now + ((folded & 1U) != 0 ? static_cast<Number>(~half) : half));
            numbers[row * columns + column] = now;
        }
    }
    return numbers;
}

}  // namespace seamflow::test
