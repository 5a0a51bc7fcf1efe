#include "solvers/denoising/rim_filter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The radius of bumps that lose half their height, in edges of the rim: stairs have runs of several edges.
constexpr double radius_in_edges = 4.0;

// The following numbers were chosen by hand on rims whose true shape is known, all of which were used for the choice:
// stairs of discs, ellipses and polygons that were cut out of grids along edges, white noise of 0.05 to 0.5 edges,
// toothed wheels, stars, combs and letters, the rims of about 30 clean meshes, and of two range scans, which are
// frayed.

/// The fewest vertices of a rim that is judged.
constexpr std::size_t fewest_vertices = 48;
/// The largest fraction of vertices at corners: noise makes no corners, frays and shapes of short edges make many.
constexpr double most_corners = 0.08;
/// The least root mean square distance of noise from the smooth curve, in edges: less is rounding, or the curve of a
/// clean shape.
constexpr double least_distance = 0.01;
/// The most revival of noise or stairs: a pattern comes back (see Distances::revival). Noise had up to 0.7, stairs up
/// to 1.2, teeth 1.4 and more.
constexpr double most_revival = 1.3;
/// The bounds of the kurtosis of the distances: the least of stairs, the least of noise where the surface has none, and
/// the most of both. The kurtosis is 1 for teeth, 1.8 for stairs, 3 for noise, and large where most vertices lie on the
/// curve.
constexpr double least_kurtosis = 1.6;
constexpr double least_kurtosis_of_noise = 2.2;
constexpr double most_kurtosis = 4.2;
/// The upper bound where the surface has noise. Noise along random directions has 5.4 within the surface.
constexpr double most_kurtosis_on_noise = 8.0;
/// The largest correlation of neighbouring distances of stairs: stairs had -0.58 and less, noise around -0.15, shapes
/// above 0.
constexpr double most_correlation_of_stairs = -0.5;

/// The distances of the vertices of a rim from a smooth curve, in edges.
struct Distances {
    Eigen::VectorXd of_vertices;
    bool is_closed;

    /// The autocorrelation of the distances: the mean product of two distances whose vertices are `lag` apart, over the
    /// mean square.
    [[nodiscard]] double correlation(Index lag) const
    {
        const auto n = static_cast<Index>(of_vertices.size());
        const Index rest = n - lag;
        double total = of_vertices.head(rest).dot(of_vertices.tail(rest));
        if (is_closed)
            total += of_vertices.head(lag).dot(of_vertices.tail(lag));
        const auto count = static_cast<double>(is_closed ? n : rest);
        return total / count / (of_vertices.squaredNorm() / static_cast<double>(n));
    }

    /// The largest rise of the autocorrelation after it has fallen. It is large for a pattern, which comes back.
    [[nodiscard]] double revival() const
    {
        constexpr Index nearest = 3;
        constexpr Index furthest = 40;
        const Index end = std::min(furthest, static_cast<Index>(of_vertices.size()) / 2);
        double least = 1.0;
        double most = 0.0;
        for (Index lag = 1; lag < end; ++lag) {
            const double here = correlation(lag);
            if (lag >= nearest)
                most = std::max(most, here - least);
            least = std::min(least, here);
        }
        return most;
    }

    /// The mean fourth power over the square of the mean square.
    [[nodiscard]] double kurtosis() const
    {
        const double square = of_vertices.squaredNorm() / static_cast<double>(of_vertices.size());
        return of_vertices.array().pow(4).mean() / (square * square);
    }
};

/// Whether a curve has noise or stairs, and not a shape that was made to look like that.
/// @param smoothness one per vertex: near 0 at corners, near 1 elsewhere. @param is_on_noise whether the surface around
/// the curve has noise.
bool is_noisy(const Distances& distances, const std::vector<double>& smoothness, bool is_on_noise)
{
    double corners = 0.0;
    for (const double s : smoothness)
        corners += (1.0 - s) / static_cast<double>(smoothness.size());
    const auto n = static_cast<double>(distances.of_vertices.size());
    if (corners > most_corners || distances.of_vertices.norm() < least_distance * std::sqrt(n))
        return false;
    const double kurtosis = distances.kurtosis();
    const double correlation = distances.correlation(1);
    if (kurtosis < least_kurtosis || kurtosis > (is_on_noise ? most_kurtosis_on_noise : most_kurtosis) ||
        distances.revival() > most_revival)
        return false;
    return correlation < most_correlation_of_stairs ||
           (correlation < 0.0 && (is_on_noise || kurtosis > least_kurtosis_of_noise));
}

/// The mean length of the edges of a curve.
/// @param positions one row per vertex of the curve.
double mean_length(const RimCurve& curve, const Points& positions)
{
    double total = 0.0;
    for (std::size_t s = 0; s < curve.faces.size(); ++s) {
        const std::size_t after = s + 1 < curve.vertices.size() ? s + 1 : 0;
        total += (positions.row(static_cast<Eigen::Index>(after)) - positions.row(static_cast<Eigen::Index>(s))).norm();
    }
    return total / static_cast<double>(std::max(curve.faces.size(), std::size_t{1}));
}

}  // namespace

RimFilter::RimFilter(const PolygonMesh& mesh, const Topology& topology)
    : curves_(find_rim_curves(mesh, topology))
    , vertex_normals_(mesh, topology)
{
    std::erase_if(curves_, [](const RimCurve& curve) { return curve.vertices.size() < fewest_vertices; });
}

Points RimFilter::motions(const PolygonMesh& mesh, const Topology& topology, const Points& normals,
                          std::span<const double> shares, const Points& positions) const
{
    Points motions = Points::Zero(mesh.n_vertices(), 3);
    for (const RimCurve& curve : curves_) {
        const Points before = positions(curve.vertices, Eigen::all);
        const double edge = mean_length(curve, before);
        const SmoothCurve smooth = smooth_curve(curve, before, radius_in_edges * edge, true);
        const Points across = across_curve(curve, smooth.positions, normals);
        const Eigen::VectorXd distances = (smooth.positions - before).cwiseProduct(across).rowwise().sum();
        double on_noise = 0.0;
        for (const Index v : curve.vertices)
            on_noise += shares[v] / static_cast<double>(curve.vertices.size());
        if (!is_noisy({distances / edge, curve.is_closed}, smooth.smoothness, on_noise > 0.5))
            continue;
        for (std::size_t i = 0; i < curve.vertices.size(); ++i)
            if (const Index v = curve.vertices[i]; topology.moves(v))
                motions.row(v) = distances[static_cast<Eigen::Index>(i)] * across.row(static_cast<Eigen::Index>(i));
    }
    spread_into_band(mesh, topology, curves_, vertex_normals_, positions, motions);
    keep_areas(mesh, positions, normals, motions);
    return motions;
}

}  // namespace seamflow
