#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian_kind.h"

namespace seamflow {

/// Δ_A = W_V d0ᵀ R W1 Rᵀ d0 (paper, eq. 15), without a stabilisation term. Per face, K = d0ᵀ R W1 Rᵀ d0 = B Bᵀ / |f|
/// with the corner bisectors bₖ as rows of B (see corner_bisector); M = W_V⁻¹ has the areas of the vertices (eq. 11).
struct AlexaWardetzky {
    static constexpr LaplacianTraits traits{
        Laplacian::AlexaWardetzky, "alexa-wardetzky", "Δ_A", Reach::Faces, Divisor::FaceAreas, true};

    /// |f|, in length².
    static double size(std::span<const Index> corners, const Points& positions) { return area(corners, positions); }
    /// |f| / p (paper, eq. 11), in length².
    static double corner_mass(double size, std::size_t p) { return corner_area(size, p); }

    /// The bisectors of a polygon.
    using Scratch = std::vector<Point>;

    /// The contribution of one face: see kernels.h.
    class Face : public AreaPolygon {
      public:
        /// Row i of scale · B Bᵀ.
        struct Row {
            Point scaled;
            const Point* bisectors;
            double operator()(std::size_t k) const { return scaled.dot(bisectors[k]); }
        };

        Face(const AreaPolygon& polygon, const Point* bisectors)
            : AreaPolygon(polygon)
            , bisectors_(bisectors)
        {
        }

        /// |f|: W1 of eq. 15 divides by it.
        [[nodiscard]] double divisor() const { return face_area(); }
        [[nodiscard]] Row row(std::size_t i, double scale) const { return {scale * bisectors_[i], bisectors_}; }
        /// See kernels.h: S = 0, C = B / √|f|, D = -1.
        [[nodiscard]] static RingEntries ring(std::size_t) { return {}; }
        [[nodiscard]] static std::array<double, 3> auxiliary() { return {-1.0, -1.0, -1.0}; }
        [[nodiscard]] std::array<double, 3> coupling(std::size_t k) const
        {
            const Point c = bisectors_[k] / std::sqrt(face_area());
            return {c[0], c[1], c[2]};
        }

      private:
        const Point* bisectors_;
    };

    static Face polygon(std::span<const Index> corners, const Points& positions, double size, Scratch& scratch)
    {
        scratch.resize(corners.size());
        for (std::size_t k = 0; k < corners.size(); ++k)
            scratch[k] = corner_bisector(corners, k, positions);
        return {{corners, positions, size}, scratch.data()};
    }

    /// The contribution of a triangle: its bisectors are half the opposite edges, so that the entries of K are half the
    /// cotangents of the angles opposite its edges, and each row of K sums to zero.
    class Triangle {
      public:
        /// Row i: minus the cotangents opposite to the edges ik, and their sum on the diagonal.
        struct Row {
            std::array<double, 3> opposite;
            std::size_t i;
            double operator()(std::size_t k) const
            {
                return k == i ? opposite[i == 0 ? 1 : 0] + opposite[i == 2 ? 1 : 2] : -opposite[3 - i - k];
            }
        };

        Triangle(const std::array<Index, 3>& corners, const Points& positions)
            : corners_(corners)
            , edges_(edges_of(corners, positions))
            , double_area_(edges_[0].cross(edges_[1]).norm())
            , dots_{edges_[0].dot(edges_[1]), edges_[0].dot(edges_[0] - edges_[1]), edges_[1].dot(edges_[2])}
        {
        }

        [[nodiscard]] static constexpr std::size_t size() { return 3; }
        [[nodiscard]] Index corner(std::size_t k) const { return corners_[k]; }
        [[nodiscard]] double mass(std::size_t) const { return double_area_ / 6.0; }
        [[nodiscard]] double divisor() const { return 2.0 * double_area_; }
        [[nodiscard]] Row row(std::size_t i, double scale) const
        {
            return {{scale * dots_[0], scale * dots_[1], scale * dots_[2]}, i};
        }
        [[nodiscard]] const Point& difference(std::size_t i, std::size_t k) const { return edges_[i + k - 1]; }

      private:
        static std::array<Point, 3> edges_of(const std::array<Index, 3>& corners, const Points& positions)
        {
            const Point first = positions.row(corners[1]) - positions.row(corners[0]);
            const Point second = positions.row(corners[2]) - positions.row(corners[0]);
            return {first, second, second - first};
        }

        std::array<Index, 3> corners_;
        /// The edges from corner 0 to 1, from 0 to 2, and from 1 to 2.
        std::array<Point, 3> edges_;
        double double_area_;
        /// The scalar product of the two edges at each corner.
        std::array<double, 3> dots_;
    };
};

}  // namespace seamflow
