#pragma once

#include <filesystem>
#include <memory>

#include "engine/distributed/files/shared_mesh_file.h"
#include "partition/loop.h"

namespace seamflow {

/// An OBJ file of which every rank reads and writes about as many bytes, up to the end of a line. All ranks have to see
/// the file under this path. Normals (`vn`) stay as they are.
/// @param loop runs what is done piece by piece.
/// @throws InputError naming the file.
std::unique_ptr<SharedMeshFile> open_sliced_obj(const std::filesystem::path& path, const FileSharing& sharing,
                                                const Loop& loop);

}  // namespace seamflow
