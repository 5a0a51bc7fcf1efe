#pragma once

#include "partition/metrics/triangle_crossing.h"

/// What triangle_crossing.h says of triangles, by predicates that are exact: for the few that doubles do not settle.
namespace seamflow::exact {

/// Whether the corners lie on one line.
bool is_flat(const Corners& t);

/// Whether two triangles that have area have a point in common.
bool meet(const Corners& a, const Corners& b);

/// The same of triangles that share their first corner and no other: beyond that.
bool meet_beyond_corner(const Corners& a, const Corners& b);

/// The same of triangles that share their first two corners and not the third: beyond the edge between them.
bool meet_beyond_edge(const Corners& a, const Corners& b);

}  // namespace seamflow::exact
