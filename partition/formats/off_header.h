#pragma once

#include <cstdint>
#include <string_view>

#include "partition/io/text_scanner.h"

namespace seamflow {

/// The beginning of a text OFF file.
struct OffHeader {
    /// What stands before OFF: ST, C, N together mean texture coordinates, colours and normals of the vertices.
    std::string_view prefix;
    std::int64_t n_vertices = 0;
    std::int64_t n_faces = 0;

    [[nodiscard]] std::int64_t n_lines() const { return n_vertices + n_faces; }
    [[nodiscard]] bool has_normals() const { return prefix.ends_with('N'); }
};

/// Reads from the beginning of the file to the end of the counts.
/// @throws InputError naming the line; also for vertices that have not three coordinates, and for counts that the file
///         is too short for.
OffHeader read_off_header(TextScanner& scanner);

}  // namespace seamflow
