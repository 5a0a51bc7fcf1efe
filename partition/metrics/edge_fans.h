#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"

namespace seamflow {

/// An edge with fewer triangles makes no fan.
inline constexpr Index fewest_of_edge_fan = 256;

/// The triangles around an edge that so many share that to try all pairs of them would take too long.
struct EdgeFan {
    Edge edge;
    /// Their numbers, ascending.
    std::vector<Index> triangles;
};

/// The fans of a mesh; a triangle is in one at most. Linear in the number of triangles if there are none.
/// @param n_vertices that the triangles have.
std::vector<EdgeFan> edge_fans_of(std::span<const Triangle> triangles, Index n_vertices);

/// Calls visit(i, j) for all pairs of triangles at an edge that are on the same side of it in one plane, and for a few
/// that nearly are. Of n triangles in n log n operations, if there are few such pairs.
/// @param edge the two ends. @param third the other corner of each triangle. All are finite.
/// @param visit returns whether to continue.
void for_each_pair_in_one_plane(const std::array<Point, 2>& edge, std::span<const Point> third,
                                const std::function<bool(Index i, Index j)>& visit);

}  // namespace seamflow
