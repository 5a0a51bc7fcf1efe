#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "solvers/denoising/local_fits.h"
#include "solvers/denoising/vertex_averages.h"

namespace seamflow {

/// Correlated noise, which is similar at neighbouring vertices, and its removal by local fits (see LocalFits).
///
/// The residuals of the widest fits, on the calmer half of the surface, have the covariances of the noise, reduced by
/// the share that such fits remove, which is known. White noise and noise with a Gaussian correlation are sought that
/// together explain these covariances. From this noise and the residuals follows the risk of fits of any radius, their
/// expected squared distance from the true surface (Mallows' Cp, with the terms of Altman, Kernel smoothing of data
/// with correlated errors, 1990; Stein, 1981). At each vertex, the fits of all radii are mixed, those with the least
/// risk nearly alone. The result is then fitted once more with the mean of these radii. Bits do not depend on how loops
/// are run.
class CorrelatedNoise {
  public:
    /// @param topology twins are not used. @param averages of the mesh. @param signs #F: 1 or -1, by which vector areas
    /// are multiplied so that they point to one side (see face_signs); or empty. All of these must outlive the object.
    /// @param before #V by 3.
    CorrelatedNoise(const PolygonMesh& mesh, const Topology& topology, const VertexAverages& averages,
                    std::span<const std::int8_t> signs, const Points& before, const Executor& exec = run_serially);

    /// The standard deviation of the noise along the normals, white and correlated noise together, in lengths of the
    /// edges at each vertex. On surfaces with white noise alone, it was found up to twice too large.
    [[nodiscard]] double deviation() const { return std::sqrt(covariances_[0]); }

    /// Whether the surface has as much correlated noise, beside white noise, as scanners leave. Hardly any, far more
    /// than white noise, or the largest length tried is rather shape than noise. False also if fits would reduce the
    /// risk by hardly anything (see least_risk).
    [[nodiscard]] bool is_plausible() const;

    /// The risk of the best fits over the risk of leaving the surface as it is: above 1 if fits would remove more than
    /// noise; infinite if there is no noise.
    [[nodiscard]] double least_risk() const;

    /// #V by 3: the positions without the correlated noise. Fixed vertices keep their positions.
    [[nodiscard]] Points without(const Executor& exec = run_serially) const;

  private:
    /// The radii of the fits, in edges.
    static constexpr std::array<double, 4> radii{2.2, 3.1, 4.4, 6.2};
    static constexpr auto n_radii = static_cast<Eigen::Index>(radii.size());
    /// The number of distances at which covariances are measured. Lag k has the pairs whose distance is within a
    /// quarter of an edge of k / 2 edges.
    static constexpr std::size_t n_lags = 9;
    /// One number per radius, and one per lag.
    using OfRadii = Eigen::Array<double, 1, n_radii>;
    using OfLags = Eigen::Array<double, 1, n_lags>;

    /// #V by 3: unit normals of the vertices, averaged over some rounds; 0 where there is none.
    [[nodiscard]] Points normals_of(const Points& positions, int rounds, const Executor& exec) const;
    /// The mean length of the edges around v; 1 if it is 0.
    [[nodiscard]] double edge_at(Index v) const { return edges_[v] > 0.0 ? edges_[v] : 1.0; }
    /// Averages the squared heights around each face (squares_), and finds the calmer half of the surface (is_calm_,
    /// calm_squares_).
    void find_calm_half(const Executor& exec);
    /// Finds the noise that explains the residuals (covariances_, noise_in_fits_, is_bounded_).
    void find_covariances(const Executor& exec);

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const VertexAverages& averages_;
    std::span<const std::int8_t> signs_;
    const Points& before_;
    /// #V: the mean length of the edges around the vertex.
    std::vector<double> edges_;
    Points normals_;
    /// #V by number of radii, in edges: the heights of the fits above the vertices.
    LocalFits::Heights heights_;
    /// #F by number of radii: the mean squared heights around each face.
    VertexAverages::Rows squares_;
    /// #V: 1 in the calmer half of the surface.
    std::vector<std::uint8_t> is_calm_;
    /// Per radius, the mean squared height on the calmer half of the surface, in squared edges.
    OfRadii calm_squares_;
    /// The covariances of the noise at the lags, in squared edges.
    OfLags covariances_;
    /// Per radius, the covariance of the noise at a vertex and the value of the fit there, in squared edges. It is not
    /// that with heights_, which are fits minus vertices.
    OfRadii noise_in_fits_;
    /// Whether the amount and the length of the noise are within the bounds of plausible noise.
    bool is_bounded_ = false;
};

}  // namespace seamflow
