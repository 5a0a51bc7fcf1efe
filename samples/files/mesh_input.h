#pragma once

#include <cstdint>
#include <filesystem>

#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// Checks that there are faces.
/// @param left_out what of the file is not among the faces.
/// @throws InputError
void require_faces(const std::filesystem::path& path, std::int64_t n_faces, const FaultLog& left_out = {});

/// Reads a surface: a mesh with faces.
/// @param left_out receives faces and numbers that cannot be used and leave no doubt about the rest (see
///        FaultLog::of_faces_alone), unless it is null: then they are errors, too.
/// @throws as read_mesh.
MeshFile read_surface(const std::filesystem::path& path, FaultLog* left_out, const Executor& exec);

}  // namespace seamflow
