#pragma once

#include <vector>

#include "partition/formats/data_file.h"
#include "partition/index.h"

namespace seamflow {

/// Reads edges of a mesh: from an .obj file its polylines (lines `l`), from a .ply file its elements `edge` (properties
/// vertex1 and vertex2), from any other file two vertex numbers per line, from 0; blank lines and anything after a #
/// are skipped.
/// @param n_vertices of the mesh.
/// @returns the edges in the order of the file. Each is between two vertices of the mesh, but need not be an edge of a
/// face.
/// @throws InputError naming file and line or element, and a remedy; also for an .obj or .ply file without edges, and
/// for a file of another mesh format, which cannot have edges.
std::vector<Edge> read_edges(const DataFile& file, Index n_vertices);

}  // namespace seamflow
