#pragma once

#include <filesystem>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads the sub-mesh of every face: one whole number of at least 0 a line, in the order of the faces. Space around the
/// numbers and empty lines at the end do not matter.
/// @param n_faces the number of labels that there must be.
/// @throws InputError naming the file and the line.
std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces);

}  // namespace seamflow
