#pragma once

#include <filesystem>
#include <string_view>

#include "partition/io/output_file.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads Wavefront OBJ: the lines `v` (further numbers, a weight or a colour, are passed over) and `f` (texture
/// coordinates and normals of the corners are passed over). All other lines, among them points and polylines, are
/// passed over: they describe no polygon.
/// @param path for messages only.
/// @throws InputError naming the line.
PolygonMesh read_obj(const std::filesystem::path& path, std::string_view text);

/// Writes Wavefront OBJ.
/// @throws OutputError
void write_obj(OutputFile& file, const PolygonMesh& mesh);

}  // namespace seamflow
