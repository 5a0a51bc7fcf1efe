#pragma once

#include "partition/vector_area.h"

namespace seamflow {

/// Squared distance of the origin from the segment between a and b, which may be one point.
double squared_distance_to_segment(const Point& a, const Point& b);

/// Squared distance of the origin from the triangle abc, in length². The triangle may be as thin as it likes, a segment
/// or a point. The origin being one of the corners or the middle of the triangle gives a small number, but what the
/// rounding of the corners leaves of it.
double squared_distance_to_triangle(const Point& a, const Point& b, const Point& c);

}  // namespace seamflow
