#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "samples/page/file_colours.h"

namespace seamflow {

/// What read_file_colours reads of an OBJ file: colours behind the coordinates of vertices, `vt`, and of the material
/// files that `mtllib` names, which are looked for beside it, `Kd` and `map_Kd`.
/// @param path of the text, for messages, and for the place of the other files. @param left_out see read_file_colours.
/// @throws InputError if the text does not fit the mesh.
FileColours read_obj_colours(const std::filesystem::path& path, std::string_view text, const PolygonMesh& mesh,
                             std::span<const Index> left_out);

}  // namespace seamflow
