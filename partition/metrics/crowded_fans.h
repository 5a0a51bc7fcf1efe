#pragma once

#include <functional>
#include <span>
#include <vector>

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"

namespace seamflow {

/// An edge or vertex with fewer triangles makes no crowded fan.
inline constexpr Index fewest_of_crowded_fan = 256;

/// The triangles around an edge or a vertex that so many share that to try all pairs of them would take too long.
struct CrowdedFan {
    /// The two ends of the edge, or twice the vertex.
    Edge edge;
    /// Their numbers, ascending.
    std::vector<Index> triangles;
};

/// The crowded fans of a mesh, those of edges first; a triangle is in one at most. Linear in the number of triangles if
/// there are none.
/// @param n_vertices that the triangles have.
std::vector<CrowdedFan> crowded_fans_of(std::span<const Triangle> triangles, Index n_vertices);

/// Calls visit(i, j) for all pairs of triangles of a fan that may cross: around an edge, those that are on the same
/// side of it in one plane, around a vertex, those that are in the same direction from it; and for a few others. Of n
/// triangles in n log n operations, if there are few such pairs.
/// @param corners of each triangle, finite.
/// @param visit returns whether to continue.
void for_each_pair_in_one_direction(const CrowdedFan& fan, std::span<const Triangle> corners, const Points& positions,
                                    const std::function<bool(Index i, Index j)>& visit);

}  // namespace seamflow
