#pragma once

#include <filesystem>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Writes a state of a mesh as PLY, each vertex with the colour of the height (z) that it had in the input, from blue
/// (lowest) to red, and that height as the property `height`: the height map that the paper lays on its meshes as a
/// texture. Where vertices are dragged along the surface, the colours are.
/// @param input the mesh before the flow.
/// @throws OutputError naming the file.
void write_picture(const std::filesystem::path& path, const PolygonMesh& input, const Points& positions);

}  // namespace seamflow
