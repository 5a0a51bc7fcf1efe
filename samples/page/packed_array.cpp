#include "samples/page/packed_array.h"

#include <cassert>
#include <new>
#include <type_traits>
#include <vector>

#include <zlib.h>

#include "partition/formats/gltf_text.h"

namespace seamflow {

namespace {

template <class Number>
std::vector<std::uint8_t> planes_of_differences(std::span<const Number> numbers, std::size_t columns)
{
    assert(numbers.size() % columns == 0);
    using Signed = std::make_signed_t<Number>;
    const std::size_t rows = numbers.size() / columns;
    std::vector<std::uint8_t> bytes(numbers.size_bytes());
    for (std::size_t column = 0; column < columns; ++column) {
        std::uint8_t* const planes = bytes.data() + column * rows * sizeof(Number);
        Number before = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            const Number now = numbers[row * columns + column];
            const auto difference = static_cast<Signed>(static_cast<Number>(now - before));
            const auto twice = static_cast<Number>(static_cast<Number>(difference) << 1U);
            const auto folded = static_cast<Number>(difference < 0 ? ~twice : twice);
            for (std::size_t byte = 0; byte < sizeof(Number); ++byte)
                planes[byte * rows + row] = static_cast<std::uint8_t>(folded >> (8 * byte) & 255U);
            before = now;
        }
    }
    return bytes;
}

}  // namespace

std::string packed(std::span<const std::uint8_t> bytes)
{
    uLongf size = compressBound(bytes.size());
    std::vector<std::uint8_t> stream(size);
    // With enough room, the only way to fail.
    if (compress2(stream.data(), &size, bytes.data(), bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    std::string text;
    append_base64({reinterpret_cast<const char*>(stream.data()), size}, text);
    return text;
}

std::string packed(std::span<const std::uint16_t> numbers, std::size_t columns)
{
    return packed(planes_of_differences(numbers, columns));
}

std::string packed(std::span<const std::uint32_t> numbers, std::size_t columns)
{
    return packed(planes_of_differences(numbers, columns));
}

}  // namespace seamflow
