#pragma once

#include <filesystem>
#include <span>

#include "partition/formats/mesh_file.h"
#include "samples/page/file_colours.h"

namespace seamflow {

/// Reads the colours of a file: the vertices' from OBJ and PLY; from OBJ the materials (colour Kd and image map_Kd),
/// and from PLY the image that `comment TextureFile` names, with texture coordinates of vertices or of corners. Images
/// are searched for at the path given there and beside the file. Anything unreadable is left out, with a remark.
/// @param path of the file that was read. @param left_out ascending: the numbers of its faces that are not in the mesh.
FileColours read_file_colours(const std::filesystem::path& path, const MeshFile& read, std::span<const Index> left_out);

}  // namespace seamflow
