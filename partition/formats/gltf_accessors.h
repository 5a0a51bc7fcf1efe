#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "partition/formats/gltf_content.h"
#include "partition/io/byte_order.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The bytes of the elements of an accessor: `size` bytes each, `stride` apart, beginning at byte `offset` of a buffer.
/// They are known to be within the buffer.
struct GltfSpan {
    std::size_t buffer = 0;
    std::size_t offset = 0;
    std::size_t stride = 0;
    std::size_t size = 0;
    std::size_t count = 0;
    /// The type of the numbers, as in the file: gltf_byte, gltf_short, gltf_int or gltf_float, or 5120 or 5122
    /// (signed).
    std::uint64_t component = 0;
    std::size_t n_components = 0;

    /// The index of the byte after the last element.
    [[nodiscard]] std::size_t end() const { return offset + (count - 1) * stride + size; }

    friend bool operator==(const GltfSpan&, const GltfSpan&) = default;
};

/// The types of numbers in a file, as in OpenGL: unsigned integers of 1, 2 and 4 bytes, and floats.
inline constexpr std::uint64_t gltf_byte = 5121;
inline constexpr std::uint64_t gltf_short = 5123;
inline constexpr std::uint64_t gltf_int = 5125;
inline constexpr std::uint64_t gltf_float = 5126;

/// The value of an index: unsigned, of 1, 2 or 4 bytes.
/// @param bytes of the element.
inline std::uint32_t gltf_index(const char* bytes, std::uint64_t component)
{
    switch (component) {
    case gltf_byte:
        return static_cast<unsigned char>(*bytes);
    case gltf_short:
        return from_bytes<std::uint16_t>(bytes, std::endian::little);
    default:
        return from_bytes<std::uint32_t>(bytes, std::endian::little);
    }
}

/// Element i of a span of three floats each.
/// @param bytes of the buffer.
inline Point float_vector(std::string_view bytes, const GltfSpan& span, std::size_t i)
{
    const char* const begin = bytes.data() + span.offset + i * span.stride;
    const auto number = [&](std::size_t k) {
        return from_bytes<float>(begin + k * sizeof(float), std::endian::little);
    };
    return {number(0), number(1), number(2)};
}

/// Checks that indices are single unsigned integers of 1, 2 or 4 bytes.
/// @throws InputError naming `name` if they are not.
void require_gltf_indices(const GltfSpan& span, const GltfValue& name);

/// The elements of an accessor.
/// @throws InputError naming the accessor or the view if it is not within its buffer, or cannot be used: compressed,
///         sparse or without data.
GltfSpan span_of_gltf(const GltfContent& content, const GltfValue& accessor);

/// An accessor of which some elements are replaced by values that are listed elsewhere in the file.
struct GltfSparse {
    /// The number of the accessor.
    std::size_t accessor = 0;
    /// The elements without replacements; nothing: zeros.
    std::optional<GltfSpan> base;
    /// The indices of the replaced elements, ascending.
    GltfSpan indices;
    /// The replacements, in the order of `indices`.
    GltfSpan values;
    /// All elements after replacement, in a buffer that is not in the file.
    GltfSpan dense;
};

/// Finds the elements of a sparse accessor and gives them a buffer, see GltfContent::add_buffer.
/// @param number of the accessor. @throws InputError as span_of_gltf; also for indices that do not ascend or are out of
///         range.
GltfSparse sparse_of_gltf(GltfContent& content, const GltfValue& number);

/// The bytes of GltfSparse::dense.
/// @param buffer the bytes of each buffer of the file.
std::string dense_bytes(const GltfSparse& sparse, const std::function<std::string_view(std::size_t)>& buffer);

}  // namespace seamflow
