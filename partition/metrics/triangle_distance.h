#pragma once

#include "partition/vector_area.h"

namespace seamflow {

/// Squared distance of the origin from the segment between a and b, which may be one point.
double squared_distance_to_segment(const Point& a, const Point& b);

/// Squared distance of the origin from the triangle abc, in length². The triangle may be as thin as it likes, a segment
/// or a point. Never less than the truth but by rounding: it is always taken to a point of the triangle. Pass the
/// corners relative to the point of interest, and no offset costs precision.
double squared_distance_to_triangle(const Point& a, const Point& b, const Point& c);

}  // namespace seamflow
