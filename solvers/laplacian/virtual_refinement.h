#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include "solvers/laplacian/alexa_wardetzky.h"
#include "solvers/laplacian/geometry.h"
#include "solvers/laplacian/laplacian_kind.h"

namespace seamflow {

/// Δ_B of Bunge, Herholz, Kazhdan and Botsch (Polygon Laplacian Made Simple, 2020). A face with more than three corners
/// xₖ gets a virtual vertex x = Σ wₖ xₖ, Σ wₖ = 1, for which the fan of triangles (xₖ, xₖ₊₁, x) has the least sum of
/// squared areas; w is the shortest vector of weights with this x. K = Pᵀ F P with the cotangent stiffness F of the fan
/// and P = [I; wᵀ]. M has the areas of the vertices, as for Δ_A (AlexaWardetzky). On triangles, Δ_B equals Δ_A. K is
/// positive semi-definite, and 0 for constants alone.
struct VirtualRefinement {
    static constexpr LaplacianTraits traits{
        Laplacian::VirtualRefinement, "virtual-refinement", "Δ_B", Reach::Faces, Divisor::FaceAreas, true};

    using Triangle = AlexaWardetzky::Triangle;

    /// |f|.
    static double size(std::span<const Index> corners, const Points& positions) { return area(corners, positions); }
    /// |f| / p (paper, eq. 11).
    static double corner_mass(double size, std::size_t p) { return corner_area(size, p); }

    /// The virtual vertex of a polygon. Positions are relative to the first corner, so that an offset of the mesh costs
    /// no precision.
    class VirtualVertex {
      public:
        VirtualVertex(std::span<const Index> corners, const Points& positions)
            : corners_(corners)
            , positions_(positions)
        {
            for (std::size_t k = 0; k < corners.size(); ++k)
                mean_ += position(k);
            mean_ /= static_cast<double>(corners.size());
            const Point from_mean = least_areas();
            position_ = mean_ + from_mean;
            gradient_ = gradient_of_weights(from_mean);
        }

        /// xₖ, relative to the first corner.
        [[nodiscard]] Point position(std::size_t k) const
        {
            return positions_.row(corners_[k]) - positions_.row(corners_[0]);
        }
        /// x, relative to the first corner.
        [[nodiscard]] const Point& position() const { return position_; }
        /// wₖ.
        [[nodiscard]] double weight(std::size_t k) const
        {
            return 1.0 / static_cast<double>(corners_.size()) + gradient_.dot(position(k) - mean_);
        }

      private:
        /// A polygon whose relative extent in a direction is below this is flat in it: the extent is rounding.
        static constexpr double flat = 1e-8;
        /// The attraction of x by the mean of the corners, as a fraction of the attraction by areas: it determines x
        /// where areas do not, as in a polygon without width.
        static constexpr double attraction = 1e-14;

        /// x - mean for which Σ |(x - xₖ) × dₖ|² is least, with dₖ = xₖ₊₁ - xₖ.
        [[nodiscard]] Point least_areas() const
        {
            Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
            Eigen::Vector3d right = Eigen::Vector3d::Zero();
            for (std::size_t k = 0; k < corners_.size(); ++k) {
                const Eigen::Vector3d here = (position(k) - mean_).transpose();
                const Eigen::Vector3d edge = (position(k + 1 == corners_.size() ? 0 : k + 1) - position(k)).transpose();
                const double squared = edge.squaredNorm();
                products -= edge * edge.transpose();
                products.diagonal().array() += squared;
                right += squared * here - edge.dot(here) * edge;
            }
            products.diagonal().array() += attraction * products.trace();
            return products.llt().solve(right).transpose();
        }

        /// The shortest w with Σ wₖ (xₖ - mean) = from_mean is wₖ = 1/p + g · (xₖ - mean). Returns g, by the method of
        /// conjugate directions: linear functions on the corners are made orthogonal, the largest first.
        [[nodiscard]] Point gradient_of_weights(const Point& from_mean) const
        {
            std::array<Point, 3> directions{Point::UnitX(), Point::UnitY(), Point::UnitZ()};
            Point gradient = Point::Zero();
            double first = 0.0;
            for (std::size_t j = 0; j < 3; ++j) {
                Point squares = Point::Zero();
                for (std::size_t m = j; m < 3; ++m)
                    squares[static_cast<Eigen::Index>(m)] = product(directions[m], directions[m]);
                Eigen::Index largest = 0;
                const double square = squares.maxCoeff(&largest);
                first = j == 0 ? square : first;
                if (!(square > flat * flat * first))
                    break;
                std::swap(directions[j], directions[static_cast<std::size_t>(largest)]);
                gradient += from_mean.dot(directions[j]) / square * directions[j];
                for (std::size_t m = j + 1; m < 3; ++m)
                    directions[m] -= product(directions[j], directions[m]) / square * directions[j];
            }
            return gradient;
        }

        /// Inner product of two linear functions on the corners.
        [[nodiscard]] double product(const Point& a, const Point& b) const
        {
            double sum = 0.0;
            for (std::size_t k = 0; k < corners_.size(); ++k) {
                const Point here = position(k) - mean_;
                sum += here.dot(a) * here.dot(b);
            }
            return sum;
        }

        std::span<const Index> corners_;
        const Points& positions_;
        Point mean_ = Point::Zero();
        Point position_;
        Point gradient_;
    };

    /// Entries of the cotangent stiffness of the triangle k of a fan.
    struct FanTriangle {
        double here;
        double next;
        double here_to_next;
        double virtual_to_here;
        double virtual_to_next;
    };

    static FanTriangle fan_triangle(const VirtualVertex& x, std::size_t k, std::size_t p)
    {
        // The least ratio of height to width of a triangle: thinner triangles count as if they had this ratio.
        constexpr double thin = 1e-10;
        const Point here = x.position(k);
        const Point next = x.position(k + 1 == p ? 0 : k + 1);
        // The edges opposite to the corners: the present one, the next one, the virtual vertex.
        const std::array<Point, 3> edges{x.position() - next, here - x.position(), next - here};
        const double widest = std::max({edges[0].squaredNorm(), edges[1].squaredNorm(), edges[2].squaredNorm()});
        if (widest == 0.0)
            return {};
        const double scale = 0.5 / std::max(edges[0].cross(edges[2]).norm(), thin * widest);
        return {scale * edges[0].squaredNorm(), scale * edges[1].squaredNorm(), scale * edges[0].dot(edges[1]),
                scale * edges[2].dot(edges[0]), scale * edges[2].dot(edges[1])};
    }

    /// The data of a corner: its weight, and the entries of F for it with itself, with the next corner, and with the
    /// virtual vertex.
    struct Corner {
        double weight;
        double diagonal;
        double to_next;
        double to_virtual;
    };

    using Scratch = std::vector<Corner>;

    /// Contribution of one face: see kernels.h.
    class Face : public AreaPolygon {
      public:
        /// Row i of scale · K.
        struct Row {
            Corner own;
            std::size_t i;
            std::size_t size;
            double at_virtual;
            double scale;
            const Corner* corners;

            double operator()(std::size_t k) const
            {
                const Corner& other = corners[k];
                const double entry = own.weight * other.to_virtual + own.to_virtual * other.weight +
                                     at_virtual * own.weight * other.weight;
                return scale * (entry + of_fan(k, other));
            }

          private:
            /// F_ik.
            [[nodiscard]] double of_fan(std::size_t k, const Corner& other) const
            {
                if (k == i)
                    return own.diagonal;
                if (k == (i + 1 == size ? 0 : i + 1))
                    return own.to_next;
                return i == (k + 1 == size ? 0 : k + 1) ? other.to_next : 0.0;
            }
        };

        Face(const AreaPolygon& polygon, const Corner* of_fan)
            : AreaPolygon(polygon)
            , of_fan_(of_fan)
        {
            for (std::size_t k = 0; k < size(); ++k)
                at_virtual_ -= of_fan_[k].to_virtual;
        }

        [[nodiscard]] static constexpr double divisor() { return 1.0; }
        [[nodiscard]] Row row(std::size_t i, double scale) const
        {
            return {of_fan_[i], i, size(), at_virtual_, scale, of_fan_};
        }
        /// See kernels.h: with f the column of the virtual vertex in F and φ its diagonal entry, K = F + f wᵀ + w fᵀ +
        /// φ w wᵀ = F - f fᵀ / φ + (f + φ w) (f + φ w)ᵀ / φ.
        [[nodiscard]] RingEntries ring(std::size_t k) const { return {of_fan_[k].diagonal, of_fan_[k].to_next}; }
        [[nodiscard]] std::array<double, 2> auxiliary() const { return {at_virtual_, -at_virtual_}; }
        [[nodiscard]] std::array<double, 2> coupling(std::size_t k) const
        {
            const Corner& corner = of_fan_[k];
            return {corner.to_virtual, corner.to_virtual + at_virtual_ * corner.weight};
        }

      private:
        const Corner* of_fan_;
        /// The diagonal entry of F for the virtual vertex.
        double at_virtual_ = 0.0;
    };

    static Face polygon(std::span<const Index> corners, const Points& positions, double size, Scratch& scratch)
    {
        const std::size_t p = corners.size();
        const VirtualVertex x(corners, positions);
        scratch.assign(p, Corner{});
        for (std::size_t k = 0; k < p; ++k) {
            const FanTriangle triangle = fan_triangle(x, k, p);
            Corner& here = scratch[k];
            Corner& next = scratch[k + 1 == p ? 0 : k + 1];
            here.weight = x.weight(k);
            here.diagonal += triangle.here;
            here.to_next = triangle.here_to_next;
            here.to_virtual += triangle.virtual_to_here;
            next.diagonal += triangle.next;
            next.to_virtual += triangle.virtual_to_next;
        }
        return {{corners, positions, size}, scratch.data()};
    }
};

}  // namespace seamflow
