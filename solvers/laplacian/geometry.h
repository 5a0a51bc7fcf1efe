#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

namespace seamflow {

/// The vector scaled to length 1; 0 for the zero vector.
inline Point unit_or_zero(const Point& vector)
{
    const double length = vector.norm();
    return length > 0.0 ? Point(vector / length) : Point(Point::Zero());
}

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

/// Entries of a symmetric matrix on a ring of corners: the diagonal entry of a corner, and the entry of the corner and
/// the next one.
struct RingEntries {
    double here = 0.0;
    double to_next = 0.0;
};

/// A polygon whose corners have equal shares of its area.
class AreaPolygon {
  public:
    /// The arrays must outlive this.
    AreaPolygon(std::span<const Index> corners, const Points& positions, double face_area)
        : corners_(corners)
        , positions_(positions)
        , area_(face_area)
    {
    }

    [[nodiscard]] std::size_t size() const { return corners_.size(); }
    [[nodiscard]] Index corner(std::size_t k) const { return corners_[k]; }
    /// |f| / p, in length².
    [[nodiscard]] double mass(std::size_t /*k*/) const { return corner_area(area_, size()); }
    [[nodiscard]] Point difference(std::size_t i, std::size_t k) const
    {
        return positions_.row(corners_[k]) - positions_.row(corners_[i]);
    }
    /// |f|, in length².
    [[nodiscard]] double face_area() const { return area_; }

  private:
    std::span<const Index> corners_;
    const Points& positions_;
    double area_;
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
