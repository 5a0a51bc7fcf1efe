#pragma once

#include <filesystem>
#include <string_view>

#include "partition/io/output_file.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads text OFF, a vertex or a face a line: `OFF` and its variants with normals, colours or texture coordinates
/// (NOFF, COFF, STOFF, STCNOFF, …), which are passed over as are the colours of faces; also a file that begins with the
/// three counts instead of `OFF`. A file that begins with `OFF BINARY` is read as binary (see read_binary_off).
/// @param path for messages only.
/// @throws InputError naming the line or byte; also for coordinates that are not three to a vertex.
PolygonMesh read_off(const std::filesystem::path& path, std::string_view text);

/// Writes text OFF.
/// @throws OutputError
void write_off(OutputFile& file, const PolygonMesh& mesh);

}  // namespace seamflow
