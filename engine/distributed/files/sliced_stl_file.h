#pragma once

#include <filesystem>
#include <memory>

#include "engine/distributed/files/shared_mesh_file.h"

namespace seamflow {

/// A binary STL file of which every rank reads and writes a slice. All ranks have to see the file under this path. It
/// is read once more when it is written: the vertices of its facets are not kept.
/// @throws InputError naming the file.
std::unique_ptr<SharedMeshFile> open_sliced_stl(const std::filesystem::path& path, const FileSharing& sharing);

}  // namespace seamflow
