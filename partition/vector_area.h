#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "partition/polygon_mesh.h"

namespace seamflow {

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

/// The length of the vector area, in length²; 0 if it is no more than rounding, or not a normal double.
///
/// A face has an area if it exceeds 16 ε n Σ|e|² over its n edges e, with ε = 2⁻⁵²: 1.6 to 2.1e-14 of the squared
/// longest edge of a triangle whose corners are nearly in a row. Differences and products in the vector area round to
/// less than ε (Σ|e|)² ≤ ε n Σ|e|², and coordinates of up to some ten edges round to as much. Moreover, the stiffness
/// matrix K of a face without area would be rounding: its entries grow with Σ|e|² / area, and their rounding errors
/// move vertices by up to ε times that, in edges, which is 1 / (16 n) or less here: 0.02 for a triangle. The distance
/// from the origin does not matter: far away, corners in a row rarely stay in a row when they are rounded, and the
/// resulting triangles are exact and thick enough for K.
inline double area_above_rounding(std::span<const Index> corners, const Points& positions)
{
    constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
    const double area = vector_area(corners, positions).norm();
    double squares = 0.0;
    Index before = corners.back();
    for (const Index v : corners) {
        squares += (positions.row(v) - positions.row(before)).squaredNorm();
        before = v;
    }
    return std::isnormal(area) && area > rounding * static_cast<double>(corners.size()) * squares ? area : 0.0;
}

/// Whether a face has an area (see area_above_rounding): a normal, and a stiffness matrix.
inline bool has_area(std::span<const Index> corners, const Points& positions)
{
    return area_above_rounding(corners, positions) > 0.0;
}

}  // namespace seamflow
