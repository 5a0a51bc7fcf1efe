#pragma once

#include <cstdint>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// Finds vertices with a coordinate that stands for missing data, such as -9999 where a height is not known: those that
/// have the smallest or the largest value of a coordinate, if it is away from all other values by several times their
/// range, and fewer than half of the vertices have it.
/// @param positions #V by 3.
/// @returns #V: 1 at these vertices; empty: there are none.
std::vector<std::uint8_t> vertices_without_data(const PolygonMesh& mesh, const Points& positions);

}  // namespace seamflow
