#pragma once

#include <filesystem>
#include <vector>

#include "partition/index.h"

namespace seamflow {

/// Reads edges of a mesh: from an .obj file its polylines (lines `l`), from a .ply file its elements `edge` (properties
/// vertex1 and vertex2), from any other file two vertex numbers per line, from 0; blank lines and anything after a #
/// are skipped.
/// @param n_vertices of the mesh.
/// @returns in the order of the file; each is between two vertices of the mesh, whether or not faces have it.
/// @throws InputError naming file and line or element, and what to do; also where an .obj or .ply file has none, and
/// for a file of another format of meshes, which cannot have any.
std::vector<Edge> read_edges(const std::filesystem::path& path, Index n_vertices);

}  // namespace seamflow
