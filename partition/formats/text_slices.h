#pragma once

#include <cstdint>
#include <span>
#include <string_view>

/// Text mesh files in slices.
namespace seamflow {

/// Counts up to a place in a file.
struct TextCounts {
    /// Lines with a token after the header, where they alone give the element of a line: in OFF and PLY.
    std::int64_t n_lines = 0;
    /// Lines `v` and `vn` of OBJ.
    std::int64_t n_vertices = 0;
    std::int64_t n_normals = 0;

    TextCounts& operator+=(const TextCounts& other)
    {
        n_lines += other.n_lines;
        n_vertices += other.n_vertices;
        n_normals += other.n_normals;
        return *this;
    }
    friend bool operator==(const TextCounts&, const TextCounts&) = default;
};

/// Some consecutive slices of a file.
struct TextSlices {
    std::span<const std::string_view> bytes;
    /// The counts before each slice and after the last, in the whole file.
    std::span<const TextCounts> counts;
    /// Of the whole file.
    TextCounts all;
};

}  // namespace seamflow
