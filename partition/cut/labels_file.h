#pragma once

#include <filesystem>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads the labels of a mesh's faces from a text file: one whole number of at least 0 a line, in the order of the
/// faces. Blank lines and whatever follows a # are skipped.
/// @throws InputError "path:line: …" if the file cannot be read, a line is not a label, or there are not n_faces.
std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces);

}  // namespace seamflow
