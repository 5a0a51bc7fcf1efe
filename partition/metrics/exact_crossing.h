#pragma once

#include "partition/vector_area.h"

/// What triangle_crossing.h says of triangles, by predicates that are exact: for the few that doubles do not settle.
namespace seamflow::exact {

/// Whether the corners lie on one line.
bool is_flat(const TriangleCorners& t);

/// Whether two triangles that have area have a point in common.
bool meet(const TriangleCorners& a, const TriangleCorners& b);

/// The same of triangles that share their first corner and no other: beyond that.
bool meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b);

/// The same of triangles that share their first two corners and not the third: beyond the edge between them.
bool meet_beyond_edge(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace seamflow::exact
