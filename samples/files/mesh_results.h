#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"

namespace seamflow {

/// Writes a state of a mesh: in the form of the input (see write_mesh_like) if the format of `path` is the same and the
/// sub-meshes are joined, else as a plain mesh.
/// @param separated the sub-meshes, each with its own copies of shared vertices; null: they are joined.
/// @param seam_distance see write_mesh_like.
/// @returns remarks for the user.
/// @throws OutputError, InputError (see write_mesh_like).
std::vector<std::string> write_state(const std::filesystem::path& path, const PolygonMesh& mesh,
                                     const PolygonMesh* separated, const MeshFile& input,
                                     const Executor& exec = run_serially, double seam_distance = 0.0);

/// Lists the data of the input that such a file will not have.
/// @param joined whether the sub-meshes will be joined.
/// @returns remarks for the user.
std::vector<std::string> remarks_on_losses(const std::filesystem::path& path, bool joined, const MeshFile& input,
                                           const Executor& exec = run_serially);

/// Checks that there are faces.
/// @param left_out what of the file is not among the faces.
/// @throws InputError
void require_faces(const std::filesystem::path& path, std::int64_t n_faces, const FaultLog& left_out = {});

/// A remark on the parts of a file that were left out of the flow.
/// @param path, joined see remarks_on_losses. @param input the kind of the file.
std::string remark_on_faces(const FaultLog& faults, const std::filesystem::path& path, bool joined,
                            const FileKind& input);

/// The labels of the faces that flow.
/// @param left_out ascending: the numbers in the file of the other faces, which have labels, too.
/// @throws InputError (see read_labels).
std::vector<Index> labels_of_faces(const std::filesystem::path& path, Index n_faces,
                                   const std::vector<Index>& left_out);

}  // namespace seamflow
