#pragma once

#include <filesystem>
#include <memory>

#include "engine/distributed/files/shared_mesh_file.h"
#include "partition/executor.h"
#include "partition/formats/mesh_io.h"

namespace seamflow {

/// An STL file of which every rank reads and writes a slice. All ranks must see the file under this path. It is read
/// once more when it is written: the vertices of its facets are not kept.
/// @param encoding of the file. @param exec runs what is done piece by piece.
/// @throws InputError naming the file.
std::unique_ptr<SharedMeshFile> open_sliced_stl(const std::filesystem::path& path, Encoding encoding,
                                                const FileSharing& sharing, const Executor& exec);

}  // namespace seamflow
