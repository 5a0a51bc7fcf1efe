#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "partition/formats/text_vertices.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// The header of a text OFF file.
struct OffHeader {
    /// The prefix of OFF: ST, C and N, each optional, in any order, stand for texture coordinates, colours and normals
    /// of the vertices. Their numbers follow the coordinates in the order normals, colours, texture coordinates.
    std::string_view prefix;
    std::int64_t n_vertices = 0;
    std::int64_t n_faces = 0;

    [[nodiscard]] std::int64_t n_lines() const { return n_vertices + n_faces; }
    [[nodiscard]] bool has_normals() const { return prefix.find('N') != std::string_view::npos; }
    [[nodiscard]] bool has_texture() const { return prefix.find("ST") != std::string_view::npos; }
    [[nodiscard]] bool has_colours() const { return prefix.find('C') != std::string_view::npos; }

    [[nodiscard]] VertexLayout layout() const { return {has_normals(), has_texture() ? 2 : 0}; }
};

/// The offset of the data if the first line is `OFF BINARY`; otherwise nothing.
std::optional<std::size_t> start_of_binary_off(std::string_view content);

/// Reads from the beginning of the file to the end of the counts.
/// @throws InputError naming the line; also for vertices without three coordinates, and for counts that the file is too
///         short for.
OffHeader read_off_header(TextScanner& scanner);

}  // namespace seamflow
