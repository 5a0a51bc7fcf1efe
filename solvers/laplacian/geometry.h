#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// |f|: length of the vector area, in length².
inline double area(std::span<const Index> corners, const Points& positions)
{
    return vector_area(corners, positions).norm();
}

/// A corner's share of the area of a p-gon, |f| / p. The sum at a vertex is its area, the inverse of the paper's W_V
/// (eq. 11).
inline double corner_area(double face_area, std::size_t p)
{
    return face_area / static_cast<double>(p);
}

/// Entries of a symmetric matrix on a ring of corners: at a corner, and at it and the next one.
struct RingEntries {
    double here = 0.0;
    double to_next = 0.0;
};

/// Mean of a polygon's corners.
inline Point centroid(std::span<const Index> corners, const Points& positions)
{
    Point sum = Point::Zero();
    for (const Index v : corners)
        sum += positions.row(v);
    return sum / static_cast<double>(corners.size());
}

/// bₖ = ½ (vₖ₊₁ - vₖ₋₁) of a polygon's corner k. With E the polygon's edge vectors as rows, d0 its exterior derivative
/// and R the matrix of the paper (eqs. 7 to 9), the rows of d0ᵀ R E are these bₖ: R E maps to centroid minus
/// edge midpoint.
inline Point corner_bisector(std::span<const Index> corners, std::size_t k, const Points& positions)
{
    const std::size_t p = corners.size();
    return 0.5 * (positions.row(corners[k + 1 == p ? 0 : k + 1]) - positions.row(corners[k == 0 ? p - 1 : k - 1]));
}

}  // namespace seamflow
