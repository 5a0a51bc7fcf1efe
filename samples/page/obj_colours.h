#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "samples/page/file_colours.h"

namespace seamflow {

/// read_file_colours for an OBJ file: reads colours after the coordinates of vertices, `vt`, and `Kd` and `map_Kd` of
/// the material files that `mtllib` names, which are searched for beside it.
/// @param path of the text, for messages, and to locate the other files. @param left_out see read_file_colours.
/// @throws InputError if the text does not fit the mesh.
FileColours read_obj_colours(const std::filesystem::path& path, std::string_view text, const PolygonMesh& mesh,
                             std::span<const Index> left_out);

}  // namespace seamflow
