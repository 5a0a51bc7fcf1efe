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

/// Noise that is alike over several edges, and its removal by local fits (see LocalFits).
///
/// What the widest fits leave over, on the calmer half of the surface, has the covariances of the noise, less what such
/// fits take of it, which is known. So white noise and noise whose correlation falls as a Gaussian are looked for that
/// explain the covariances together. With these the risk of fits of any radius, their expected squared distance from
/// the true surface, follows from what they leave over (Mallows' Cp, with the terms of Altman, Kernel smoothing of data
/// with correlated errors, 1990; Stein, 1981). Each place gets the radii that have the least risk there, and the same
/// once again on the result. Bits do not depend on how loops are run.
class AlikeNoise {
  public:
    /// @param topology twins are not used. @param averages of the mesh. @param signs #F: see face_signs. All must
    /// outlive the object. @param before #V by 3.
    AlikeNoise(const PolygonMesh& mesh, const Topology& topology, const VertexAverages& averages,
               std::span<const std::int8_t> signs, const Points& before, const Executor& exec = run_serially);

    /// Of noise that is alike at neighbours; where it is white, up to twice as much was found.
    /// The standard deviation along the normals, in lengths of the edges at each vertex.
    [[nodiscard]] double deviation() const { return std::sqrt(covariances_[0]); }

    /// Whether the surface has as much of it, beside white noise, as scanners leave: if there is hardly any, or far
    /// more than white noise, or over as many edges as can be told, it is rather shape.
    [[nodiscard]] bool is_plausible() const;

    /// The risk of the best fits over that of doing nothing: above 1 where they would take more than noise.
    [[nodiscard]] double least_risk() const;

    /// #V by 3: the positions without that noise. Held vertices stay.
    [[nodiscard]] Points without(const Executor& exec = run_serially) const;

  private:
    /// In edges.
    static constexpr std::array<double, 4> radii{2.2, 3.1, 4.4, 6.2};
    static constexpr auto n_radii = static_cast<Eigen::Index>(radii.size());
    /// Of distances from half an edge less to half an edge more than a multiple of half an edge.
    static constexpr std::size_t n_lags = 9;
    using OfRadii = Eigen::Array<double, 1, n_radii>;
    using OfLags = Eigen::Array<double, 1, n_lags>;

    [[nodiscard]] Points normals_of(const Points& positions, int rounds, const Executor& exec) const;
    [[nodiscard]] double edge_at(Index v) const { return edges_[v] > 0.0 ? edges_[v] : 1.0; }
    void find_places(const Executor& exec);
    void find_covariances(const Executor& exec);

    const PolygonMesh& mesh_;
    const Topology& topology_;
    const VertexAverages& averages_;
    std::span<const std::int8_t> signs_;
    const Points& before_;
    /// #V: of the edges around, in length.
    std::vector<double> edges_;
    Points normals_;
    /// #V by number of radii, in edges: of the fits above the vertices.
    LocalFits::Heights heights_;
    /// #F by number of radii: their mean squares around each face.
    VertexAverages::Rows squares_;
    /// #V: 1 within the calmer half.
    std::vector<std::uint8_t> is_calm_;
    OfRadii calm_squares_;
    /// Of the noise, in squared edges.
    OfLags covariances_;
    /// The covariances of the noise and the fitted heights, in squared edges.
    OfRadii shared_;
    /// Whether there is as much of it as can be told from white noise and from shape.
    bool is_bounded_ = false;
};

}  // namespace seamflow
