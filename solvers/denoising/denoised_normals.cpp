#include "solvers/denoising/denoised_normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "solvers/denoising/mixing_network.h"
#include "solvers/denoising/mixing_weights.h"
#include "solvers/denoising/normal_estimates.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

namespace {

/// The relaxation of vertices when they are fitted between two networks, which need not be exact.
constexpr double relaxation_between = 0.1;
constexpr int relaxing_rounds_between = 5;
constexpr int plain_rounds_between = 8;
/// Normals within this many rings of faces of a boundary are averaged once more; and σ of that average, a chord of unit
/// normals (see FaceAverages). On five range scans, the errors there fell by 3 to 6 %.
constexpr int rings_near_rims = 3;
constexpr float sigma_near_rims = 0.4F;

/// The normals, scaled to length 1, each turned to the side of its face's vector area.
/// @param signs #F: -1 for faces whose vector areas point to the other side than the normals (see face_signs),
/// otherwise 1; empty: 1 for all.
Points own_sides(const FaceVectors& normals, const std::vector<std::int8_t>& signs, const Executor& exec)
{
    Points result(normals.rows(), 3);
    for_each(exec, static_cast<Index>(normals.rows()), [&](Index f) {
        result.row(f) = normals.row(f).head<3>().cast<double>();
        if (const double length = result.row(f).norm(); length > 0.0)
            result.row(f) *= (signs.empty() ? 1.0 : signs[f]) / length;
    });
    return result;
}

/// #F: 1 for faces within `rings_near_rims` rings of a boundary.
std::vector<std::uint8_t> faces_near_rims(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    std::vector<std::uint8_t> is_near(usize(mesh.n_faces()), 0);
    std::vector<std::uint8_t> is_there(topology.kind.size());
    for_each(exec, mesh.n_vertices(), [&](Index v) { is_there[v] = topology.kind[v] == VertexKind::Boundary ? 1 : 0; });
    for (int ring = 0; ring < rings_near_rims; ++ring) {
        for_each(exec, mesh.n_faces(), [&](Index f) {
            is_near[f] = std::ranges::any_of(mesh.face(f), [&](Index v) { return is_there[v] != 0; }) ? 1 : 0;
        });
        for_each(exec, mesh.n_vertices(), [&](Index v) {
            for (const Index corner : topology.corners_at(v))
                if (is_near[topology.face_of[corner]] != 0)
                    is_there[v] = 1;
        });
    }
    return is_near;
}

/// Near a boundary, filters have fewer faces to average over. There, the bilateral mean of the estimated normals is
/// nearer to the true normal.
void average_near_rims(const PolygonMesh& mesh, const Topology& topology, const FaceAverages& averages,
                       FaceVectors& normals, const Executor& exec)
{
    if (std::ranges::find(topology.kind, VertexKind::Boundary) == topology.kind.end())
        return;
    const std::vector<std::uint8_t> is_near = faces_near_rims(mesh, topology, exec);
    FaceVectors means;
    averages.average(sigma_near_rims, normals, means, exec);
    normalise(means, exec);
    for_each(exec, mesh.n_faces(), [&](Index f) {
        if (is_near[f] != 0 && !means.row(f).isZero(0.0F))
            normals.row(f) = means.row(f);
    });
}

/// Denoises the normals of a whole mesh or piece.
/// @param topology with twins.
DenoisedNormals denoise_at_once(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    const Points& positions = mesh.vertices;
    NormalEstimator estimator(mesh, topology, exec);
    estimator.begin(positions, exec);
    DenoisedNormals found;
    FaceVectors normals;
    NormalEstimates estimates;
    EstimateFeatures features;
    for (std::size_t stage = 0; stage < mixing_weights().size(); ++stage) {
        if (stage > 0) {
            Points fitted = positions;
            fit_vertices(
                mesh, topology, {},
                {own_sides(normals, {}, exec), relaxation_between, relaxing_rounds_between, plain_rounds_between},
                fitted, exec);
            estimator.refine(fitted, exec);
        }
        if (stage == 0)
            estimator.first(estimates, exec);
        else
            estimator.further(normals, estimates, exec);
        features.measure(estimates, estimator.vertex_averages(), exec);
        if (stage == 0) {
            found.noise = MixingNetwork(noise_weights()).apply(features, exec);
            // The output of this network is the logarithm of the noise.
            for_each(exec, mesh.n_faces(), [&](Index f) { found.noise[f] = std::exp(found.noise[f]); });
        }
        normals = MixingNetwork(mixing_weights()[stage]).mix(estimates, features, exec);
    }
    normalise(normals, exec);
    average_near_rims(mesh, topology, estimator.averages(), normals, exec);
    found.normals = own_sides(normals, estimator.averages().signs(), exec);
    return found;
}

}  // namespace

DenoisedNormals denoise_normals(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                const Executor& exec, Index most_faces)
{
    std::vector<Index> all(usize(mesh.n_faces()));
    std::iota(all.begin(), all.end(), 0);
    DenoisedNormals found{Points(mesh.n_faces(), 3), std::vector<float>(all.size())};
    for_each_piece(mesh, topology, positions, std::move(all), {.most_faces = most_faces}, exec,
                   [&](const MeshPiece& piece, std::span<const std::uint8_t> is_own) {
                       const DenoisedNormals of_piece = denoise_at_once(piece.mesh, piece.topology, exec);
                       for_each(exec, piece.mesh.n_faces(), [&](Index i) {
                           if (is_own[i] == 0)
                               return;
                           found.normals.row(piece.faces[i]) = of_piece.normals.row(i);
                           found.noise[piece.faces[i]] = of_piece.noise[i];
                       });
                   });
    return found;
}

}  // namespace seamflow
