#include "solvers/denoising/correlated_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "partition/vector_area.h"
#include "solvers/denoising/nearest_vertices.h"
#include "solvers/denoising/normal_motion.h"

namespace seamflow {

namespace {

/// Rounds over which vertex normals, edge lengths and squared heights are averaged.
constexpr int rounds_of_vertex_normals = 3;
constexpr int rounds_of_edges = 4;
constexpr int rounds_of_places = 30;
/// The difference of two neighbouring lags, in edges.
constexpr double width_of_lags = 0.5;
/// The lengths that are tried for correlated noise, in edges: at this distance the correlation is exp(-1/4).
constexpr std::array<double, 7> correlation_lengths{0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8};
/// The bounds of the variance of correlated noise over that of white noise; outside of these it is rather shape. Five
/// scans had 0.7 to 2.4, relief with white noise of a tenth of an edge 2.8 and more.
constexpr double least_correlated = 0.1;
constexpr double most_correlated = 2.6;
/// Fits with a larger risk, relative to the variance of the noise, are not used.
constexpr double most_risk = 0.95;
/// The difference of risks, relative to the variance of the noise, at which the weight of a radius falls to 1/e.
constexpr double risk_temperature = 0.05;
/// The mean square at a single place is uncertain: this fraction of its expected value comes from the calmer half of
/// the surface, the rest from the place.
constexpr double part_of_calm = 0.75;
/// The bounds of the variance of the noise at a place, relative to the variance on the calmer half.
constexpr double least_share_of_noise = 0.25;
constexpr double most_share_of_noise = 16.0;

/// The covariances of the residuals of local fits on a regular mesh, at some distances along a line.
/// @param lags the distances, in edges. @param covariance the covariance of the heights before the fits, as a function
/// of the distance in edges.
template <class Covariance>
std::vector<double> residual_covariances(const LocalFits::Kernel& kernel, std::span<const double> lags,
                                         Covariance&& covariance)
{
    const auto between = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
        return covariance((to - from).norm());
    };
    std::vector<double> result;
    for (const double lag : lags) {
        const Eigen::Vector2d place(lag, 0.0);
        double total = covariance(lag);
        for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
            double fitted = 0.0;
            for (std::size_t j = 0; j < kernel.weights.size(); ++j)
                fitted += kernel.weights[j] * between(kernel.offsets[i], place + kernel.offsets[j]);
            // By symmetry, the two mixed terms are equal.
            total += kernel.weights[i] * (fitted - 2.0 * between(kernel.offsets[i], place));
        }
        result.push_back(total);
    }
    return result;
}

/// The Gaussian correlation over a length at a distance, both in edges.
double gaussian_at(double distance, double length)
{
    return std::exp(-distance * distance / (4.0 * length * length));
}

/// The correlation of white noise at a distance in edges: 1 below half the difference of two lags, 0 beyond.
double white_at(double distance)
{
    return distance < 0.5 * width_of_lags ? 1.0 : 0.0;
}

/// White noise, and correlated noise with a Gaussian correlation over a length in edges. Both variances are in squared
/// edges.
struct TwoNoises {
    double white = 0.0;
    double correlated = 0.0;
    double length = 1.0;

    [[nodiscard]] double covariance(double distance) const
    {
        return white * white_at(distance) + correlated * gaussian_at(distance, length);
    }
};

/// The noise that explains covariances best, by least squares.
/// @param kernel of the widest fits. @param lags distances, in edges. @param seen the covariances of the residuals of
/// these fits at the lags.
TwoNoises fitted_noise(const LocalFits::Kernel& kernel, std::span<const double> lags, std::span<const double> seen)
{
    using Column = Eigen::Map<const Eigen::ArrayXd>;
    const auto size = static_cast<Eigen::Index>(lags.size());
    const Column y(seen.data(), size);
    const std::vector<double> of_white = residual_covariances(kernel, lags, white_at);
    const Column w(of_white.data(), size);
    TwoNoises best;
    double least = std::numeric_limits<double>::infinity();
    for (const double length : correlation_lengths) {
        const std::vector<double> of_correlated =
            residual_covariances(kernel, lags, [&](double d) { return gaussian_at(d, length); });
        const Column a(of_correlated.data(), size);
        // The normal equations of y = white w + correlated a, solved by Cramer's rule.
        const double ww = (w * w).sum();
        const double aa = (a * a).sum();
        const double wa = (w * a).sum();
        const double determinant = ww * aa - wa * wa;
        TwoNoises noise{((w * y).sum() * aa - (a * y).sum() * wa) / determinant,
                        ((a * y).sum() * ww - (w * y).sum() * wa) / determinant, length};
        // Variances are at least 0: if least squares makes one of them negative, the other noise alone is fitted.
        if (noise.white < 0.0)
            noise = {0.0, (a * y).sum() / aa, length};
        if (noise.correlated < 0.0)
            noise = {(w * y).sum() / ww, 0.0, length};
        if (const double rest = (y - noise.white * w - noise.correlated * a).square().sum(); rest < least) {
            least = rest;
            best = noise;
        }
    }
    return best;
}

}  // namespace

CorrelatedNoise::CorrelatedNoise(const PolygonMesh& mesh, const Topology& topology, const VertexAverages& averages,
                                 std::span<const std::int8_t> signs, const Points& before, const Executor& exec)
    : mesh_(mesh)
    , topology_(topology)
    , averages_(averages)
    , signs_(signs)
    , before_(before)
    , edges_(edge_lengths_at_vertices(mesh, topology, before, exec))
    , normals_(normals_of(before, rounds_of_vertex_normals, exec))
{
    for (int round = 0; round < rounds_of_edges; ++round) {
        const std::vector<double> last = edges_;
        for_each(exec, mesh.n_vertices(), [&](Index v) {
            for (const Index w : averages.neighbours()[v])
                edges_[v] += last[w];
            edges_[v] /= static_cast<double>(1 + averages.neighbours()[v].size());
        });
    }
    heights_ = LocalFits(averages.neighbours(), before, normals_).heights(radii, exec);
    for_each(exec, mesh.n_vertices(), [&](Index v) { heights_.row(v) /= edge_at(v); });
    find_calm_half(exec);
    find_covariances(exec);
}

Points CorrelatedNoise::normals_of(const Points& positions, int rounds, const Executor& exec) const
{
    Points normals = Points::Zero(mesh_.n_vertices(), 3);
    for_each(exec, mesh_.n_vertices(), [&](Index v) {
        if (topology_.kind[v] == VertexKind::Junction)
            return;
        Point total = Point::Zero();
        for (const Index corner : topology_.corners_at(v)) {
            const Index f = topology_.face_of[corner];
            total += (signs_.empty() ? 1.0 : signs_[f]) * vector_area(mesh_.face(f), positions);
        }
        normals.row(v) = total.stableNormalized();
    });
    for (int round = 0; round < rounds; ++round) {
        const Points last = normals;
        for_each(exec, mesh_.n_vertices(), [&](Index v) {
            Point total = last.row(v);
            for (const Index w : averages_.neighbours()[v])
                total += last.row(w);
            normals.row(v) = total.stableNormalized();
        });
    }
    return normals;
}

void CorrelatedNoise::find_calm_half(const Executor& exec)
{
    VertexAverages::Rows near(mesh_.n_faces(), n_radii);
    squares_.resize(mesh_.n_faces(), n_radii);
    for_each(exec, mesh_.n_faces(), [&](Index f) {
        near.row(f).setZero();
        for (const Index v : mesh_.face(f))
            near.row(f) += heights_.row(v).cwiseAbs2().cast<float>() / static_cast<float>(mesh_.face(f).size());
    });
    averages_.spread(near, squares_, 0, rounds_of_places, exec);
    std::vector<float> widest(usize(mesh_.n_faces()));
    for_each(exec, mesh_.n_faces(), [&](Index f) { widest[f] = squares_(f, n_radii - 1); });
    const auto middle = widest.begin() + std::ssize(widest) / 2;
    std::ranges::nth_element(widest, middle);
    is_calm_.assign(edges_.size(), 0);
    for_each(exec, mesh_.n_vertices(), [&](Index v) {
        const auto corners = topology_.corners_at(v);
        is_calm_[v] = topology_.kind[v] == VertexKind::Interior && std::ranges::all_of(corners, [&](Index corner) {
                          return squares_(topology_.face_of[corner], n_radii - 1) <= *middle;
                      });
    });
    using Sums = Eigen::Array<double, 1, n_radii + 1>;
    const Sums sums = sum(
        exec, mesh_.n_vertices(),
        [&](Index v) {
            Sums of_vertex = Sums::Zero();
            if (is_calm_[v] != 0)
                of_vertex << heights_.row(v).array().square(), 1.0;
            return of_vertex;
        },
        Sums(Sums::Zero()));
    calm_squares_ = sums.head<n_radii>() / std::max(sums[n_radii], 1.0);
}

void CorrelatedNoise::find_covariances(const Executor& exec)
{
    // Per vertex: the sums of products at the lags, and the numbers of products.
    using Sums = Eigen::Array<double, 1, 2 * n_lags>;
    const std::size_t count = LocalFits::n_within(width_of_lags * n_lags);
    const auto sums_over = [&](Index begin, Index end) {
        Sums sums = Sums::Zero();
        NearestVertices search;
        for (Index v = begin; v < end; ++v) {
            if (is_calm_[v] == 0)
                continue;
            for (const auto& [squared, w] : search.find(averages_.neighbours(), before_, v, count)) {
                const auto lag = static_cast<std::size_t>(std::sqrt(squared) / (width_of_lags * edge_at(v)) + 0.5);
                if (is_calm_[w] == 0 || lag >= n_lags)
                    continue;
                const auto place = static_cast<Eigen::Index>(lag);
                sums[place] += heights_(v, n_radii - 1) * heights_(w, n_radii - 1);
                sums[place + static_cast<Eigen::Index>(n_lags)] += 1.0;
            }
        }
        return sums;
    };
    std::vector<Sums> of_blocks(usize(mesh_.n_vertices() / block_size) + 1, Sums::Zero());
    for_each_block(exec, mesh_.n_vertices(),
                   [&](Index block, Index begin, Index end) { of_blocks[block] = sums_over(begin, end); });
    Sums total = Sums::Zero();
    for (const Sums& of_block : of_blocks)
        total += of_block;
    std::vector<double> lags;
    std::vector<double> seen;
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(n_lags); ++k)
        if (const double number = total[k + static_cast<Eigen::Index>(n_lags)]; number > 0.0) {
            lags.push_back(width_of_lags * static_cast<double>(k));
            seen.push_back(total[k] / number);
        }
    const TwoNoises noise = lags.empty() ? TwoNoises{} : fitted_noise(LocalFits::kernel(radii.back()), lags, seen);
    is_bounded_ = noise.length < correlation_lengths.back() && noise.correlated > least_correlated * noise.white &&
                  noise.correlated < most_correlated * noise.white;
    for (std::size_t k = 0; k < n_lags; ++k)
        covariances_[static_cast<Eigen::Index>(k)] = noise.covariance(width_of_lags * static_cast<double>(k));
    for (Eigen::Index i = 0; i < n_radii; ++i) {
        const LocalFits::Kernel kernel = LocalFits::kernel(radii[static_cast<std::size_t>(i)]);
        noise_in_fits_[i] = 0.0;
        for (std::size_t k = 0; k < kernel.weights.size(); ++k)
            noise_in_fits_[i] += kernel.weights[k] * noise.covariance(kernel.offsets[k].norm());
    }
}

bool CorrelatedNoise::is_plausible() const
{
    return is_bounded_ && least_risk() < most_risk;
}

double CorrelatedNoise::least_risk() const
{
    using Squares = Eigen::Array<double, 1, n_radii>;
    Squares squares = Squares::Zero();
    for (Index f = 0; f < mesh_.n_faces(); ++f)
        squares += squares_.row(f).cast<double>().array();
    squares /= std::max(mesh_.n_faces(), Index{1});
    const double variance = covariances_[0];
    return variance > 0.0 ? (squares + 2.0 * noise_in_fits_ - variance).minCoeff() / variance
                          : std::numeric_limits<double>::infinity();
}

Points CorrelatedNoise::without(const Executor& exec) const
{
    const double variance = covariances_[0];
    if (!(variance > 0.0))
        return before_;
    Points result = before_;
    // #V: the mean of the radii by their weights, with which the result is fitted once more.
    std::vector<double> mean_radii(edges_.size(), radii.front());
    for_each(exec, mesh_.n_vertices(), [&](Index v) {
        const auto corners = topology_.corners_at(v);
        if (corners.empty())
            return;
        OfRadii squares = OfRadii::Zero();
        for (const Index corner : corners)
            squares += squares_.row(topology_.face_of[corner]).cast<double>().array();
        squares /= static_cast<double>(corners.size());
        const double share = std::clamp(squares[0] / calm_squares_[0], least_share_of_noise, most_share_of_noise);
        // Squares at the place are divided by its share of noise, so that all risks are those at the noise of the
        // calmer half.
        const OfRadii risks =
            (1.0 - part_of_calm) / share * squares + part_of_calm * calm_squares_ + 2.0 * noise_in_fits_ - variance;
        // Radii with nearly the least risk are mixed, so that the result does not jump from one radius to another.
        OfRadii weights = ((risks.minCoeff() - risks) / (risk_temperature * variance)).exp();
        weights /= weights.sum();
        mean_radii[v] = (weights * Eigen::Map<const OfRadii>(radii.data())).sum();
        if (topology_.fixed[v] == 0)
            result.row(v) += edge_at(v) * (weights * heights_.row(v).array()).sum() * normals_.row(v);
    });
    const Points normals = normals_of(result, 0, exec);
    const std::vector<double> heights =
        LocalFits(averages_.neighbours(), result, normals).heights_within(mean_radii, exec);
    for_each(exec, mesh_.n_vertices(), [&](Index v) {
        if (topology_.fixed[v] == 0)
            result.row(v) += heights[v] * normals.row(v);
    });
    return result;
}

}  // namespace seamflow
