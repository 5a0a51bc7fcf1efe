#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "partition/formats/mesh_file.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

inline constexpr TextSyntax ply_syntax = {.comment = '\0', .first_line_end_decides = true};

/// One for each Encoding, in its order.
inline constexpr std::array<std::string_view, 3> ply_encodings = {"ascii", "binary_little_endian", "binary_big_endian"};

/// The types of numbers in a PLY file: char, uchar, short, ushort, int, uint, float and double, or int8 to float64, and
/// 64-bit whole numbers, which some programs add.
enum class PlyType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

/// Calls `act` with a zero of that type.
[[gnu::always_inline]] inline auto with_type(PlyType type, const auto& act)
{
    switch (type) {
    case PlyType::Int8:
        return act(std::int8_t{});
    case PlyType::UInt8:
        return act(std::uint8_t{});
    case PlyType::Int16:
        return act(std::int16_t{});
    case PlyType::UInt16:
        return act(std::uint16_t{});
    case PlyType::Int32:
        return act(std::int32_t{});
    case PlyType::UInt32:
        return act(std::uint32_t{});
    case PlyType::Int64:
        return act(std::int64_t{});
    case PlyType::UInt64:
        return act(std::uint64_t{});
    case PlyType::Float32:
        return act(float{});
    case PlyType::Float64:
        break;
    }
    return act(double{});
}

/// Size of a number in a binary file.
inline std::size_t size_in_bytes(PlyType type)
{
    return with_type(type, [](auto zero) { return sizeof zero; });
}

inline bool is_integer(PlyType type)
{
    return type != PlyType::Float32 && type != PlyType::Float64;
}

/// A property of every element of a kind: one number, or one list of numbers.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;
    /// Only for lists: the type of their lengths.
    std::optional<PlyType> length_type;
    /// The line of the header that declares the property.
    std::size_t line = 0;
    /// The word for `type` in the header; valid as long as the file.
    std::string_view type_word = {};
};

/// A kind of elements: vertices, faces, or anything else.
struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    /// The line of the header that declares the element.
    std::size_t line = 0;

    /// The property of the wanted name, or null.
    [[nodiscard]] const PlyProperty* property(std::string_view wanted) const;
};

/// For each property of an element, in order: the column of its number, as `column` gives it; -1 if the property is
/// skipped.
std::vector<Index> columns_of(const PlyElement& element, const auto& column)
{
    std::vector<Index> columns;
    for (const PlyProperty& property : element.properties)
        columns.push_back(column(property));
    return columns;
}

/// For each property of an element, in order: the index of its name in `names`; -1 if it is not among them.
std::vector<Index> columns_of(const PlyElement& element, std::initializer_list<std::string_view> names);

/// The columns of coordinates: 0 to 2 for x, y and z; -1 for other properties.
std::vector<Index> coordinates_in(const PlyElement& vertices);

/// The columns of corners: 0 for the list of corners; -1 for other properties.
std::vector<Index> corners_in(const PlyElement& faces);

/// The header of a PLY file: its encoding and the kinds of its elements.
struct PlyHeader {
    Encoding encoding = Encoding::Ascii;
    /// The kinds of elements, in the order of their data.
    std::vector<PlyElement> elements;

    /// The number of elements of all kinds together.
    [[nodiscard]] std::uint64_t n_elements() const;

    /// The element of that name, or null.
    [[nodiscard]] const PlyElement* element(std::string_view name) const;
};

/// Reads the header of a PLY file, up to and including the line end_header; the data are scanner.rest().
/// @throws InputError naming the line; also for counts that the rest of the file is too short for.
PlyHeader read_ply_header(TextScanner& scanner);

/// Checks that the vertices have a number of that name, not a list.
/// @throws InputError naming the line and the properties that they have.
void require_number(const TextScanner& scanner, const PlyElement& vertices, std::string_view name);

/// Content besides the surface, in a few words each; comments do not count.
/// @param path for messages only.
std::vector<std::string> extras_of_ply(const std::filesystem::path& path, std::string_view content);

}  // namespace seamflow
