#include "solvers/denoising/denoised_normals.h"

#include <cmath>
#include <utility>

#include "solvers/denoising/mixing_network.h"
#include "solvers/denoising/mixing_weights.h"
#include "solvers/denoising/normal_estimates.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

namespace {

/// Of fits between the stages, which need not be exact.
constexpr double relaxation_between = 0.1;
constexpr int relaxing_rounds_between = 5;
constexpr int plain_rounds_between = 8;

/// On the sides of the faces' own normals.
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

}  // namespace

NormalDenoiser::NormalDenoiser(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
    : mesh_(&mesh)
    , topology_(&topology)
    , estimator_(mesh, topology, exec)
{
}

DenoisedNormals NormalDenoiser::denoise(const Points& positions, const Executor& exec)
{
    estimator_.begin(positions, exec);
    DenoisedNormals found;
    FaceVectors normals;
    NormalEstimates estimates;
    EstimateFeatures features;
    for (std::size_t stage = 0; stage < mixing_weights().size(); ++stage) {
        if (stage > 0) {
            Points fitted = positions;
            fit_vertices(
                *mesh_, *topology_, {},
                {own_sides(normals, {}, exec), relaxation_between, relaxing_rounds_between, plain_rounds_between},
                fitted, exec);
            estimator_.refine(fitted, exec);
        }
        if (stage == 0)
            estimator_.first(estimates, exec);
        else
            estimator_.further(normals, estimates, exec);
        features.measure(estimates, estimator_.averages(), exec);
        if (stage == 0) {
            found.noise = MixingNetwork(noise_weights()).apply(features, exec);
            for_each(exec, mesh_->n_faces(), [&](Index f) { found.noise[f] = std::exp(found.noise[f]); });
        }
        normals = MixingNetwork(mixing_weights()[stage]).mix(estimates, features, exec);
    }
    found.normals = own_sides(normals, estimator_.averages().signs(), exec);
    return found;
}

}  // namespace seamflow
