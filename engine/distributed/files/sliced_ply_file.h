#pragma once

#include <filesystem>
#include <memory>

#include "engine/distributed/files/shared_mesh_file.h"
#include "partition/formats/mesh_io.h"

namespace seamflow {

/// A binary PLY or OFF file of which every rank reads and writes a slice: a binary OFF file has elements as in PLY. All
/// ranks must see the file under this path.
/// @throws InputError naming the file; also for one that cannot be cut into slices (see PlyRanges).
std::unique_ptr<SharedMeshFile> open_sliced_ply(const std::filesystem::path& path, FileFormat format,
                                                const FileSharing& sharing);

}  // namespace seamflow
