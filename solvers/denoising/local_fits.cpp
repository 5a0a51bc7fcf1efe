#include "solvers/denoising/local_fits.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "solvers/denoising/nearest_vertices.h"

namespace seamflow {

namespace {

/// The number of coefficients of a quadratic polynomial in two variables.
constexpr int n_quadratic = 6;
using QuadraticTerms = Eigen::Matrix<double, n_quadratic, 1>;
using QuadraticProducts = Eigen::Matrix<double, n_quadratic, n_quadratic>;

/// σ of the Gaussian weights, a chord of normals.
constexpr double width_of_normals = 0.35;
/// A ridge relative to the sum of the weights. It only matters if the vertices do not determine a polynomial.
constexpr double fit_ridge = 1e-6;

QuadraticTerms quadratic_terms(double x, double y)
{
    return {1.0, x, y, x * x, x * y, y * y};
}

/// The biweight function. @param squared the square of distance over radius.
double biweight(double squared)
{
    return (1.0 - squared) * (1.0 - squared);
}

/// Fits a polynomial at one vertex.
/// @param nearest squared distances and vertices: the vertex itself, then its neighbours by distance; the last one has
/// no weight.
/// @returns the height of the polynomial above the vertex; empty if there are too few vertices.
std::optional<double> fit_quadratic(const Points& positions, const Points& normals,
                                    std::span<const std::pair<double, Index>> nearest)
{
    const double squared_radius = nearest.back().first;
    if (nearest.size() <= n_quadratic || squared_radius <= 0.0)
        return {};
    const double scale = 1.0 / std::sqrt(squared_radius);
    const Index centre = nearest.front().second;
    const Point up = normals.row(centre);
    const Point first = up.unitOrthogonal();
    const Point second = up.cross(first);
    QuadraticProducts products = QuadraticProducts::Zero();
    QuadraticTerms sums = QuadraticTerms::Zero();
    for (const auto& [squared, w] : nearest.first(nearest.size() - 1)) {
        const Point there = scale * (positions.row(w) - positions.row(centre));
        const double squared_chord = (normals.row(w) - up).squaredNorm();
        const double weight =
            biweight(squared / squared_radius) * std::exp(squared_chord / (-2.0 * width_of_normals * width_of_normals));
        const QuadraticTerms terms = quadratic_terms(there.dot(first), there.dot(second));
        const QuadraticTerms weighted = weight * terms;
        products.noalias() += weighted * terms.transpose();
        sums += there.dot(up) * weighted;
    }
    products.diagonal().array() += fit_ridge * products(0, 0);
    return products.ldlt().solve(sums)[0] / scale;
}

}  // namespace

LocalFits::Heights LocalFits::heights(std::span<const double> radii, const Executor& exec) const
{
    const auto n_radii = static_cast<Eigen::Index>(radii.size());
    Heights result = Heights::Zero(neighbours_->size(), n_radii);
    exec(neighbours_->size(), [&](Index begin, Index end) {
        NearestVertices search;
        for (Index v = begin; v < end; ++v) {
            if (normals_->row(v).isZero(0.0))
                continue;
            const auto nearest = search.find(*neighbours_, *positions_, v, n_within(radii.back()));
            for (Eigen::Index i = 0; i < n_radii; ++i)
                result(v, i) = fit_quadratic(*positions_, *normals_,
                                             nearest.first(std::min(n_within(radii[static_cast<std::size_t>(i)]) + 1,
                                                                    nearest.size())))
                                   .value_or(0.0);
        }
    });
    return result;
}

std::vector<double> LocalFits::heights_within(std::span<const double> radii, const Executor& exec) const
{
    std::vector<double> result(radii.size(), 0.0);
    exec(neighbours_->size(), [&](Index begin, Index end) {
        NearestVertices search;
        for (Index v = begin; v < end; ++v)
            if (!normals_->row(v).isZero(0.0))
                result[v] =
                    fit_quadratic(*positions_, *normals_, search.find(*neighbours_, *positions_, v, n_within(radii[v])))
                        .value_or(0.0);
    });
    return result;
}

std::size_t LocalFits::n_within(double radius)
{
    // A regular mesh of triangles with edges of length 1 has 2/√3 vertices per unit of area.
    return static_cast<std::size_t>(std::lround(2.0 * std::numbers::pi / std::numbers::sqrt3 * radius * radius));
}

LocalFits::Kernel LocalFits::kernel(double radius)
{
    Kernel kernel;
    kernel.offsets.emplace_back(0.0, 0.0);
    const auto most = static_cast<int>(std::ceil(2.0 * radius));
    for (int i = -most; i <= most; ++i)
        for (int j = -most; j <= most; ++j)
            if (const Eigen::Vector2d offset(i + 0.5 * j, 0.5 * std::numbers::sqrt3 * j);
                offset.norm() < radius && (i != 0 || j != 0))
                kernel.offsets.push_back(offset);
    const auto terms_of = [&](const Eigen::Vector2d& offset) {
        return quadratic_terms(offset[0] / radius, offset[1] / radius);
    };
    const auto weight_of = [&](const Eigen::Vector2d& offset) {
        return biweight(offset.squaredNorm() / (radius * radius));
    };
    QuadraticProducts products = QuadraticProducts::Zero();
    for (const Eigen::Vector2d& offset : kernel.offsets)
        products += weight_of(offset) * terms_of(offset) * terms_of(offset).transpose();
    // The fitted height at the middle is the constant coefficient: it takes the first row of the inverse matrix.
    const QuadraticTerms row = products.ldlt().solve(QuadraticTerms::Unit(0));
    for (const Eigen::Vector2d& offset : kernel.offsets)
        kernel.weights.push_back(weight_of(offset) * row.dot(terms_of(offset)));
    return kernel;
}

}  // namespace seamflow
