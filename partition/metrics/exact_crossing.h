#pragma once

#include "partition/vector_area.h"

/// The tests of triangle_crossing.h with exact predicates, for the few triangles that doubles cannot decide.
namespace seamflow::exact {

/// Whether the corners lie on one line.
bool is_flat(const TriangleCorners& t);

/// Whether two triangles that have area have a point in common.
bool meet(const TriangleCorners& a, const TriangleCorners& b);

/// Whether two triangles that share only their first corner have another point in common.
bool meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b);

/// Whether two triangles that share only their first two corners have a point in common beyond the edge between these.
bool meet_beyond_edge(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace seamflow::exact
