#pragma once

#include <filesystem>
#include <memory>

#include "engine/distributed/files/shared_mesh_file.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/executor.h"

namespace seamflow {

/// @param exec runs what is done slice by slice, as long as the file is used.
/// @throws InputError for a file that cannot be opened, and for a compressed one that rank 0 does not read alone.
std::unique_ptr<SharedMeshFile> open_together(Communicator& comm, const std::filesystem::path& path,
                                              const FileSharing& sharing = {}, const Executor& exec = run_serially);

}  // namespace seamflow
