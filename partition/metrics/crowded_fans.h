#pragma once

#include <functional>
#include <span>
#include <vector>

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The fewest triangles of a crowded fan.
inline constexpr Index fewest_of_crowded_fan = 256;

/// The triangles around an edge or a vertex that has so many that testing all pairs of them would take too long.
struct CrowdedFan {
    /// The two ends of the edge; for a vertex, the vertex twice.
    Edge edge;
    /// The numbers of the triangles, ascending.
    std::vector<Index> triangles;
};

/// The crowded fans of a mesh, fans of edges first; a triangle is in at most one fan. Linear in the number of triangles
/// if there are no crowded fans.
/// @param n_vertices the number of vertices of the mesh.
std::vector<CrowdedFan> crowded_fans_of(std::span<const Triangle> triangles, Index n_vertices);

/// Calls visit(i, j) for all pairs of triangles of a fan that may cross: around an edge, triangles in one plane on the
/// same side of the edge; around a vertex, triangles in the same direction from it; and a few other pairs. For n
/// triangles this takes n log n operations, if there are few such pairs.
/// @param corners the corners of each triangle of the fan, in any order; i and j are indices in this list, not numbers
/// of CrowdedFan::triangles. @param positions #V by 3, finite at these corners.
/// @param visit returns whether to continue.
void for_each_pair_in_one_direction(const CrowdedFan& fan, std::span<const Triangle> corners, const Points& positions,
                                    const std::function<bool(Index i, Index j)>& visit);

}  // namespace seamflow
