#pragma once

#include "partition/vector_area.h"

namespace seamflow {

/// Whether two triangles have a point in common beyond the corners and edges that they share. Corners are shared where
/// their positions are equal, whatever their numbers are.
/// - Without a shared corner any common point counts, touching too.
/// - With one, the opposite edge of one triangle meets the other triangle.
/// - With a shared edge, they lie in one plane and on the same side of the edge.
/// - With three, they are the same triangle.
/// A triangle whose corners lie on one line crosses nothing. Exact: unaffected by rounding.
/// @param a, b finite.
bool cross(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace seamflow
