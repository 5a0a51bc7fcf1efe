#include "partition/metrics/noise.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "partition/index_lists.h"

namespace seamflow {

namespace {

constexpr Index sample_size = 10'000;
/// A quadratic function of two coordinates has six coefficients; with hardly more points it meets their noise.
constexpr std::size_t fewest_points = 9;
/// Half of what is drawn from the normal distribution of deviation 1 is nearer to 0.
constexpr double median_of_normal = 0.6744897501960817;

/// The two rings around v, without v.
std::vector<Index> two_rings(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    std::vector<Index> rings;
    const auto add_faces_at = [&](Index w) {
        for (const Index corner : topology.corners_at(w)) {
            const auto face = mesh.face(topology.face_of[corner]);
            rings.insert(rings.end(), face.begin(), face.end());
        }
    };
    add_faces_at(v);
    sort_unique(rings);
    for (const Index w : std::vector<Index>(rings))
        add_faces_at(w);
    sort_unique(rings);
    std::erase(rings, v);
    return rings;
}

std::optional<double> residual_at(const PolygonMesh& mesh, const Topology& topology, Index v)
{
    const std::vector<Index> rings = two_rings(mesh, topology, v);
    if (rings.size() < fewest_points)
        return {};
    const auto n = static_cast<Eigen::Index>(rings.size());
    Eigen::MatrixX3d points(n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
        points.row(i) = mesh.vertices.row(rings[i]) - mesh.vertices.row(v);
    const Eigen::RowVector3d centre = points.colwise().mean();
    const Eigen::MatrixX3d centred = points.rowwise() - centre;
    const double size = std::sqrt(centred.squaredNorm() / static_cast<double>(n));
    if (!std::isnormal(size))
        return {};
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centred.transpose() * centred / (size * size));
    // Of the vertex, 0, at the origin: heights are along the first axis.
    const Eigen::MatrixX3d local = points * axes.eigenvectors() / size;
    Eigen::MatrixXd functions(n, 6);
    functions << Eigen::VectorXd::Ones(n), local.col(1), local.col(2), local.col(1).cwiseAbs2(),
        local.col(1).cwiseProduct(local.col(2)), local.col(2).cwiseAbs2();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(functions);
    if (fit.rank() < functions.cols())
        return {};
    const Eigen::VectorXd coefficients = fit.solve(local.col(0));
    // The variance of the height fitted at the origin, in that of the noise: an entry of the inverse of AᵀA.
    const Eigen::MatrixXd squared = functions.transpose() * functions;
    const double of_fit = squared.ldlt().solve(Eigen::VectorXd::Unit(6, 0))[0];
    const double residual = size * std::abs(coefficients[0]) / std::sqrt(1.0 + std::max(of_fit, 0.0));
    return std::isfinite(residual) ? std::optional(residual) : std::nullopt;
}

}  // namespace

double estimate_noise(const PolygonMesh& mesh, const Topology& topology, const Loop& loop)
{
    const Index n = mesh.n_vertices();
    const Index stride = std::max(n / sample_size, 1);
    const Index n_samples = n / stride;
    std::vector<std::optional<double>> of_samples(n_samples);
    for_each(loop, n_samples, [&](Index i) {
        const Index v = i * stride;
        if (topology.kind[v] == VertexKind::Interior)
            of_samples[i] = residual_at(mesh, topology, v);
    });
    std::vector<double> residuals;
    for (const std::optional<double>& residual : of_samples)
        if (residual)
            residuals.push_back(*residual);
    if (residuals.empty())
        return 0.0;
    const auto median = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
    std::nth_element(residuals.begin(), median, residuals.end());
    return *median / median_of_normal;
}

}  // namespace seamflow
