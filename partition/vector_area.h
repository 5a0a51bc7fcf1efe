#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// One position or vector, a row of Points.
using Point = Eigen::RowVector3d;

/// The corners of a triangle, in units of length.
using TriangleCorners = std::array<Point, 3>;

/// Vector area ½ Σ vᵢ × vᵢ₊₁ of a polygon, planar or not, in length² (paper, section Discrete Laplacians). Taken
/// relative to the first corner, so that an offset of the whole mesh costs no precision.
inline Point vector_area(std::span<const Index> corners, const Points& positions)
{
    const Point origin = positions.row(corners[0]);
    if (corners.size() == 3)
        return 0.5 * (positions.row(corners[1]) - origin).cross(positions.row(corners[2]) - origin);
    Point sum = Point::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sum += (positions.row(corners[k]) - origin).cross(positions.row(corners[k + 1]) - origin);
    return 0.5 * sum;
}

}  // namespace seamflow
