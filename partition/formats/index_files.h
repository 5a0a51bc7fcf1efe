#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "partition/formats/data_file.h"
#include "partition/index.h"

/// Non-negative numbers in text files, one per line: blank lines and anything after a # are skipped.
namespace seamflow {

/// Reads the labels of a mesh's faces, in the order of the faces.
/// @throws InputError "path:line: …" if the file cannot be read, a line is not a label, or there are not n_faces.
std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces);

/// Reads a set of vertices of a mesh. From a .ply file, those whose numeric property `property` is not zero; it must
/// have as many vertices as the mesh, with or without its positions and faces. From any other file, their numbers,
/// counted from 0.
/// @returns ascending, each once.
/// @throws InputError naming file and line, element or property, and what to do.
std::vector<Index> read_vertex_set(const DataFile& file, Index n_vertices, std::string_view property);

/// Reads a weight for each vertex of a mesh: from a .ply file the property `property` (see read_vertex_set); from any
/// other file one number of at least 0 for each vertex, in their order.
/// @returns n_vertices weights, each at least 0.
/// @throws InputError naming file and line, element or property, and a remedy.
std::vector<double> read_vertex_weights(const DataFile& file, Index n_vertices, std::string_view property);

/// Reads the strength of a flow at each vertex of a mesh (see MotionOptions::strength): from a .ply file the property
/// `property` (see read_vertex_set), from 0 to 1; from any other file the vertices whose strength is 1, all others
/// having 0.
/// @returns n_vertices strengths, each from 0 to 1.
/// @throws InputError naming file and line, element or property, and a remedy.
std::vector<double> read_vertex_strengths(const DataFile& file, Index n_vertices, std::string_view property);

}  // namespace seamflow
