#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "partition/index.h"

/// Numbers of at least 0 in text files, one a line: blank lines and whatever follows a # are skipped.
namespace seamflow {

/// Reads the labels of a mesh's faces, in the order of the faces.
/// @throws InputError "path:line: …" if the file cannot be read, a line is not a label, or there are not n_faces.
std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces);

/// Reads which vertices of a mesh are meant. From a .ply file those whose property `property`, a number, is not zero;
/// it must have as many vertices as the mesh, whose positions and faces it may have or lack. From any other file their
/// numbers, counted from 0.
/// @returns ascending, each once.
/// @throws InputError naming file and line, element or property, and what to do.
std::vector<Index> read_vertex_set(const std::filesystem::path& path, Index n_vertices, std::string_view property);

/// Reads a weight for each vertex of a mesh: from a .ply file, as above, its property `property`; from any other file
/// one number of at least 0 for each vertex, in their order.
/// @returns n_vertices.
/// @throws InputError naming file and line, element or property, and what to do.
std::vector<double> read_vertex_weights(const std::filesystem::path& path, Index n_vertices, std::string_view property);

}  // namespace seamflow
