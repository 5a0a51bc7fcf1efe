#pragma once

#include <filesystem>
#include <memory>

#include "engine/distributed/files/shared_mesh_file.h"

namespace seamflow {

/// A binary PLY file of which every rank reads and writes a slice. All ranks have to see the file under this path.
/// @throws InputError naming the file; also for one that cannot be cut into slices (see PlyStretches).
std::unique_ptr<SharedMeshFile> open_sliced_ply(const std::filesystem::path& path, const FileSharing& sharing);

}  // namespace seamflow
