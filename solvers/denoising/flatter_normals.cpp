#include "solvers/denoising/flatter_normals.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "partition/vector_area.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/mesh_piece.h"

namespace seamflow {

namespace {

/// A share, by which an estimated normal is replaced by a flatter one: 0 leaves it, 1 replaces it. It changes linearly
/// between two values of a measurement, from 1 to 0.
struct Fading {
    float one_at;
    float zero_at;

    float operator()(float value) const { return std::clamp((zero_at - value) / (zero_at - one_at), 0.0F, 1.0F); }
};

// The following numbers were measured on machine parts, polyhedra, round bodies and natural shapes whose true shape is
// known, with noise of 0.1 to 0.5 along the normals.

/// The share of flatter normals by the noise, in lengths of edges.
constexpr Fading by_noise{0.2F, 0.15F};
/// The share by the fraction of edges around a face at which flatter normals are neither nearly equal nor clearly
/// different; and the least and the largest chord of such normals.
constexpr Fading by_bends{0.06F, 0.1F};
constexpr double least_bend = 0.04;
constexpr double largest_bend = 0.3;
/// The share by the misfit of flatter normals: the mean squared chord (the distance of two unit vectors) between the
/// directions of patches of the noisy surface and of the same patches with flatter normals, over the same chord with
/// the estimates.
constexpr Fading by_misfit{1.15F, 1.3F};

/// The rounds of bilateral means, and their σ (see FaceAverages).
constexpr int flattening_rounds = 12;
constexpr float flattening_sigma = 0.1F;
/// The rounds of averages over neighbours that make a patch of the faces around a face, and the rounds over which the
/// compared numbers are averaged (see VertexAverages::spread, which can also give a nearer average, not used here).
constexpr int patch_rounds = 4;
constexpr int comparing_rounds = 16;
constexpr int no_rounds_before = 0;

using FaceRows = VertexAverages::Rows;

/// The result of flattening estimated normals.
struct FlatterNormals {
    /// #F by 3: of length 1, or 0 as the estimates.
    Points normals;
    /// #F: the fraction of a face's edges at which the surface bends: by more than on facets and less than at an edge.
    std::vector<float> bends;
};

/// Replaces unit vectors by their bilateral means, several times.
void flatten(const FaceAverages& averages, FaceVectors& vectors, const Executor& exec)
{
    FaceVectors means;
    for (int round = 0; round < flattening_rounds; ++round) {
        averages.average(flattening_sigma, vectors, means, exec);
        vectors.swap(means);
        normalise(vectors, exec);
    }
}

/// The fraction of edges of face f at which the surface bends.
/// @param topology with twins. @param normals of length 1, on the same side of the surface.
float bends_at(const PolygonMesh& mesh, const Topology& topology, const FaceVectors& normals, Index f)
{
    float n_bends = 0.0F;
    for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
        if (topology.twin[h] < 0)
            continue;
        const double chord = (normals.row(f) - normals.row(topology.face_of[topology.twin[h]])).norm();
        if (chord > least_bend && chord < largest_bend)
            ++n_bends;
    }
    return n_bends / static_cast<float>(mesh.face(f).size());
}

/// The flatter normals of the whole surface, computed piece by piece.
/// @param normals #F by 3: the estimates.
FlatterNormals flatter_normals_of(const NoisySurface& surface, const Points& normals, const Executor& exec)
{
    std::vector<Index> all(usize(surface.mesh.n_faces()));
    std::iota(all.begin(), all.end(), 0);
    FlatterNormals flatter{normals, std::vector<float>(all.size())};
    for_each_piece(surface.mesh, surface.topology, surface.positions, std::move(all), {}, exec,
                   [&](const MeshPiece& piece, std::span<const std::uint8_t> is_own) {
                       FaceAverages averages(piece.mesh, piece.topology, exec);
                       averages.measure(piece.mesh.vertices, exec);
                       const auto sign = [&](Index i) { return averages.signs().empty() ? 1.0 : averages.signs()[i]; };
                       FaceVectors vectors(piece.mesh.n_faces(), 4);
                       for_each(exec, piece.mesh.n_faces(), [&](Index i) {
                           vectors.row(i) << (sign(i) * normals.row(piece.faces[i])).cast<float>(), 0.0F;
                       });
                       flatten(averages, vectors, exec);
                       for_each(exec, piece.mesh.n_faces(), [&](Index i) {
                           const Index f = piece.faces[i];
                           if (is_own[i] == 0)
                               return;
                           flatter.bends[f] = bends_at(piece.mesh, piece.topology, vectors, i);
                           if (!normals.row(f).isZero(0.0))
                               flatter.normals.row(f) = sign(i) * vectors.row(i).head<3>().cast<double>();
                       });
                   });
    return flatter;
}

/// The sums of vector areas over the patch around each face, all on the same side of the surface.
/// @param area_of gives the vector area of a face, on the side to which the order of its corners makes its normal
/// point; neighbours may have opposite orders. The signs of the surface turn them to one side.
/// @returns #F by 3: up to a positive factor.
template <class AreaOf>
FaceRows areas_of_patches(const NoisySurface& surface, AreaOf&& area_of, const Executor& exec)
{
    FaceRows of_faces(surface.mesh.n_faces(), 3);
    for_each(exec, surface.mesh.n_faces(), [&](Index f) {
        const Point area = area_of(f);
        of_faces.row(f) = (surface.signs.empty() ? area : surface.signs[f] * area).template cast<float>();
    });
    FaceRows around(surface.mesh.n_faces(), 3);
    surface.averages.spread(of_faces, around, no_rounds_before, patch_rounds, exec);
    return around;
}

/// The columns of `comparison`.
constexpr int bends_column = 0;
constexpr int misfit_of_estimated = 1;
constexpr int misfit_of_flatter = 2;

/// #F by 3, averaged around each face: the fraction of bends; the squared chord between the direction of the noisy
/// patch around a face (that of its vector area) and the direction of the same patch with the estimated normals; and
/// the squared chord with the flatter normals.
FaceRows comparison(const NoisySurface& surface, const Points& estimated, const FlatterNormals& flatter,
                    const Executor& exec)
{
    const Index n_faces = surface.mesh.n_faces();
    const auto noisy_area = [&](Index f) { return vector_area(surface.mesh.face(f), surface.positions); };
    const double total = sum(exec, n_faces, [&](Index f) { return noisy_area(f).norm(); });
    // Areas are in mean face areas, which single precision represents in any unit of length.
    const double scale = total > 0.0 ? n_faces / total : 0.0;
    const auto with = [&](const Points& normals) {
        return areas_of_patches(
            surface, [&](Index f) -> Point { return scale * noisy_area(f).norm() * normals.row(f); }, exec);
    };
    const FaceRows noisy = areas_of_patches(
        surface, [&](Index f) -> Point { return scale * noisy_area(f); }, exec);
    const FaceRows of_estimated = with(estimated);
    const FaceRows of_flatter = with(flatter.normals);
    FaceRows of_faces(n_faces, 3);
    for_each(exec, n_faces, [&](Index f) {
        const auto direction = [f](const FaceRows& areas) { return areas.row(f).head<3>().normalized(); };
        of_faces.row(f) << flatter.bends[f], (direction(of_estimated) - direction(noisy)).squaredNorm(),
            (direction(of_flatter) - direction(noisy)).squaredNorm();
    });
    FaceRows around(n_faces, 3);
    surface.averages.spread(of_faces, around, no_rounds_before, comparing_rounds, exec);
    return around;
}

}  // namespace

bool take_flatter_normals(const NoisySurface& surface, DenoisedNormals& estimated, const Executor& exec)
{
    const Index n_faces = surface.mesh.n_faces();
    std::vector<float> weights(usize(n_faces), 0.0F);
    for_each(exec, n_faces, [&](Index f) {
        if (std::ranges::any_of(surface.mesh.face(f), [&](Index v) { return surface.shares[v] > 0.0; }))
            weights[f] = by_noise(estimated.noise[f]);
    });
    const auto is_some = [](float weight) { return weight > 0.0F; };
    if (std::ranges::none_of(weights, is_some))
        return false;
    Points& normals = estimated.normals;
    const FlatterNormals flatter = flatter_normals_of(surface, normals, exec);
    const FaceRows around = comparison(surface, normals, flatter, exec);
    for_each(exec, n_faces, [&](Index f) {
        // Estimates without any misfit stay.
        const float of_estimated = around(f, misfit_of_estimated);
        const float misfit = of_estimated > 0.0F ? around(f, misfit_of_flatter) / of_estimated : by_misfit.zero_at;
        weights[f] *= by_bends(around(f, bends_column)) * by_misfit(misfit);
        if (weights[f] > 0.0F)
            normals.row(f) = (normals.row(f) + weights[f] * (flatter.normals.row(f) - normals.row(f))).normalized();
    });
    return std::ranges::any_of(weights, is_some);
}

}  // namespace seamflow
