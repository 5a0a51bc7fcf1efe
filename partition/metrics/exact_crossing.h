#pragma once

#include "partition/vector_area.h"

/// The tests of triangle_crossing.h with exact predicates, for the few triangles that doubles do not settle.
namespace seamflow::exact {

/// Whether the corners lie on one line.
bool is_flat(const TriangleCorners& t);

/// Whether two triangles that have area have a point in common.
bool meet(const TriangleCorners& a, const TriangleCorners& b);

/// The same for triangles that share only their first corner: beyond that.
bool meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b);

/// The same for triangles that share only their first two corners: beyond the edge between them.
bool meet_beyond_edge(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace seamflow::exact
