#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partition/metrics/edge_measures.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Finds vertices with a coordinate that stands for missing data, such as -9999 where a height is not known: those that
/// have the smallest or the largest value of a coordinate, or one of the two smallest or largest, if these are away
/// from all other values by several times their range, and fewer than half of the vertices have them.
/// @param positions #V by 3. @param spikes see find_spikes; those without others beside them do not count, and leave no
/// gap.
/// @returns #V: 1 at these vertices; empty: there are none.
std::vector<std::uint8_t> vertices_without_data(const PolygonMesh& mesh, const Points& positions,
                                                std::span<const Spike> spikes);

}  // namespace seamflow
