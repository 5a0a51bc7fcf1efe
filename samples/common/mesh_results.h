#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"

namespace seamflow {

/// Writes a state of a mesh: in the form of the input (see write_mesh_like) where the format of `path` is the same and
/// the sub-meshes are joined, else as a plain mesh.
/// @param separated the sub-meshes, each with its own copies of shared vertices; null: they are joined.
/// @returns remarks for the user.
/// @throws OutputError, InputError (see write_mesh_like).
std::vector<std::string> write_state(const std::filesystem::path& path, const PolygonMesh& mesh,
                                     const PolygonMesh* separated, const MeshFile& input,
                                     const Loop& loop = run_serially);

/// Says what of the input such a file will not have.
/// @param joined whether the sub-meshes will be.
/// @returns remarks for the user.
std::vector<std::string> remarks_on_losses(const std::filesystem::path& path, bool joined, const MeshFile& input,
                                           const Loop& loop = run_serially);

}  // namespace seamflow
