#include "solvers/denoising/denoised_normals.h"

#include <bit>
#include <cmath>
#include <utility>

#include "partition/decomposition/overlap.h"
#include "solvers/denoising/mesh_piece.h"
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
/// In rings of faces. With so many the results of six meshes cut into three and six pieces differed from those of the
/// whole mesh no more than if its faces came in another order, which changes the rounding.
constexpr int overlap = 16;

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
            for_each(exec, mesh.n_faces(), [&](Index f) { found.noise[f] = std::exp(found.noise[f]); });
        }
        normals = MixingNetwork(mixing_weights()[stage]).mix(estimates, features, exec);
    }
    found.normals = own_sides(normals, estimator.averages().signs(), exec);
    return found;
}

}  // namespace

DenoisedNormals denoise_normals(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                const Executor& exec, Index most_faces)
{
    const Index n_faces = mesh.n_faces();
    const auto n_pieces = static_cast<Index>(std::bit_ceil(usize((n_faces + most_faces - 1) / most_faces)));
    const std::vector<Index> piece_of =
        n_pieces > 1 ? boxes_of_faces(mesh, positions, n_pieces, exec) : std::vector<Index>(usize(n_faces), 0);
    const IndexLists pieces = make_lists(n_pieces, [&](auto&& add) {
        for (Index f = 0; f < n_faces; ++f)
            add(piece_of[f], f);
    });
    // Any piece may grow into any other.
    const std::vector<Index> same_stage(usize(n_pieces), 0);
    DenoisedNormals found{Points(n_faces, 3), std::vector<float>(usize(n_faces))};
    for (Index p = 0; p < n_pieces; ++p) {
        const MeshPiece piece = cut_out(mesh, topology, positions,
                                        grow(mesh, topology, {piece_of, same_stage, n_pieces > 1 ? overlap : 0}, p,
                                             {pieces[p].begin(), pieces[p].end()}),
                                        exec);
        const DenoisedNormals of_piece = denoise_at_once(piece.mesh, piece.topology, exec);
        for_each(exec, piece.mesh.n_faces(), [&](Index i) {
            const Index f = piece.faces[i];
            if (piece_of[f] != p)
                return;
            found.normals.row(f) = of_piece.normals.row(i);
            found.noise[f] = of_piece.noise[i];
        });
    }
    return found;
}

}  // namespace seamflow
