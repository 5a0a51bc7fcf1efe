#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "samples/page/file_colours.h"

namespace seamflow {

/// read_file_colours for a PLY file: reads the vertices' `red`, `green` and `blue`, and where a line `comment
/// TextureFile` names an image, their `texture_u` and `texture_v` (or `s`, `t`; or `u`, `v`), or the faces' list
/// `texcoord` of two numbers for each corner.
/// @param path of the file, for messages, and to locate the image. @param left_out see read_file_colours.
/// @throws InputError if the file does not fit the mesh.
FileColours read_ply_colours(const std::filesystem::path& path, std::string_view file, const PolygonMesh& mesh,
                             std::span<const Index> left_out);

}  // namespace seamflow
