#pragma once

#include "partition/vector_area.h"

namespace seamflow {

/// Whether two triangles have a point in common beyond the corners and edges that they share. Corners are shared if
/// their positions are equal, whatever their numbers.
/// - Without a shared corner: any common point counts, also a touching one.
/// - With one shared corner: the opposite edge of one triangle meets the other triangle.
/// - With a shared edge: the triangles lie in one plane and on the same side of the edge.
/// - With three shared corners: they are the same triangle.
/// A triangle whose corners lie on one line crosses nothing. The result is exact, not affected by rounding.
/// @param a, b finite.
bool cross(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace seamflow
