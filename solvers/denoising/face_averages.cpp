#include "solvers/denoising/face_averages.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// exp(-x) for x ≥ 0, to a relative error of 1e-4, by a polynomial for the fraction of a power of two: several times as
/// fast as std::exp.
inline float decay(float x)
{
    constexpr float log2_e = 1.442695F;
    constexpr float most = 80.0F;
    const float power = std::min(x, most) * log2_e;
    const auto whole = static_cast<std::int32_t>(power);
    const float f = power - static_cast<float>(whole);
    // 2⁻ᶠ, fitted on [0, 1]
    const float fraction = 1.0F + f * (-0.6930438F + f * (0.2391374F + f * (-0.0531436F + f * 0.0070499F)));
    constexpr std::int32_t bias = 127;
    constexpr std::int32_t mantissa_bits = 23;
    return fraction * std::bit_cast<float>((bias - whole) << mantissa_bits);
}

}  // namespace

FaceAverages::FaceAverages(const PolygonMesh& mesh, const Topology& topology, const Executor& exec, Sheets sheets)
    : mesh_(&mesh)
    , topology_(&topology)
    , neighbours_(make_face_neighbours(mesh, topology, exec, sheets))
    , signs_(face_signs(mesh, topology))
    , areas_(usize(mesh.n_faces()))
    , near_(neighbours_.faces.size())
{
}

void FaceAverages::measure(const Points& positions, const Executor& exec)
{
    const Index n = n_faces();
    Points centroids(n, 3);
    std::vector<double> areas(usize(n));
    for_each(exec, n, [&](Index f) {
        areas[f] = area_above_rounding(mesh_->face(f), positions);
        centroids.row(f) = centroid(mesh_->face(f), positions);
    });
    const double mean_area = sum(exec, n, [&](Index f) { return areas[f]; }) / std::max(n, Index{1});
    std::vector<double> reach(usize(n));
    for_each(exec, n, [&](Index f) {
        areas_[f] = mean_area > 0.0 ? static_cast<float>(areas[f] / mean_area) : 0.0F;
        double squares = 0.0;
        for (const Index g : neighbours_[f])
            squares += (centroids.row(f) - centroids.row(g)).squaredNorm();
        const std::size_t count = neighbours_[f].size();
        reach[f] = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
    });
    std::vector<float> mean_areas(areas_.size());
    for_each(exec, n, [&](Index f) {
        float total = areas_[f];
        for (const Index g : neighbours_[f])
            total += areas_[g];
        mean_areas[f] = total / static_cast<float>(1 + neighbours_[f].size());
    });
    for_each(exec, n, [&](Index f) {
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            const Index g = neighbours_.faces[k];
            const double squared = (centroids.row(f) - centroids.row(g)).squaredNorm();
            const double scale = reach[f] * reach[g];
            // All weights at face f are multiplied by b_f, so that the face itself has the weight a_f.
            near_[k] = scale > 0.0 && areas_[g] > 0.0F
                           ? areas_[g] * (mean_areas[f] / mean_areas[g]) * decay(static_cast<float>(squared / scale))
                           : 0.0F;
        }
    });
}

void FaceAverages::measure_normals(const Points& positions, FaceVectors& normals, const Executor& exec) const
{
    normals.resize(n_faces(), 4);
    for_each(exec, n_faces(), [&](Index f) {
        Point normal = vector_area(mesh_->face(f), positions);
        const double length = area_above_rounding(mesh_->face(f), positions);
        normal *= length > 0.0 ? (signs_.empty() ? 1.0 : signs_[f]) / length : 0.0;
        normals.row(f) << normal.cast<float>(), 0.0F;
    });
    const std::vector<Index> without = select(exec, n_faces(), [&](Index f) { return normals.row(f).isZero(); });
    FaceVectors around = FaceVectors::Zero(std::ssize(without), 4);
    for (std::size_t i = 0; i < without.size(); ++i)
        for (std::size_t k = neighbours_.offsets[without[i]]; k < neighbours_.offsets[without[i] + 1]; ++k)
            around.row(static_cast<Index>(i)) += near_[k] * normals.row(neighbours_.faces[k]);
    normalise(around, exec);
    for (std::size_t i = 0; i < without.size(); ++i)
        normals.row(without[i]) = around.row(static_cast<Index>(i));
}

void FaceAverages::weigh(AverageWeights& weights, const Executor& exec) const
{
    weights.of_neighbours.resize(near_.size());
    weights.inverse_sums.resize(areas_.size());
    for_each(exec, n_faces(), [&](Index f) {
        float total = areas_[f];
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            weights.of_neighbours[k] = near_[k];
            total += near_[k];
        }
        weights.inverse_sums[f] = total > 0.0F ? 1.0F / total : 0.0F;
    });
}

void FaceAverages::weigh(const FaceVectors& guide, float sigma, AverageWeights& weights, const Executor& exec) const
{
    weights.of_neighbours.resize(near_.size());
    weights.inverse_sums.resize(areas_.size());
    const float scale = 0.5F / (sigma * sigma);
    for_each(exec, n_faces(), [&](Index f) {
        float total = areas_[f];
        const FaceVector normal = guide.row(f);
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            const float weight = near_[k] * decay(scale * (normal - guide.row(neighbours_.faces[k])).squaredNorm());
            weights.of_neighbours[k] = weight;
            total += weight;
        }
        weights.inverse_sums[f] = total > 0.0F ? 1.0F / total : 0.0F;
    });
}

void FaceAverages::average(const AverageWeights& weights, const FaceVectors& vectors, FaceVectors& means,
                           const Executor& exec) const
{
    means.resize(n_faces(), 4);
    for_each(exec, n_faces(), [&](Index f) {
        FaceVector total = areas_[f] * vectors.row(f);
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k)
            total += weights.of_neighbours[k] * vectors.row(neighbours_.faces[k]);
        means.row(f) = weights.inverse_sums[f] * total;
    });
}

void FaceAverages::average(const FaceVectors& vectors, FaceVectors& means, const Executor& exec) const
{
    means.resize(n_faces(), 4);
    for_each(exec, n_faces(), [&](Index f) {
        FaceVector total = areas_[f] * vectors.row(f);
        float sum = areas_[f];
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            total += near_[k] * vectors.row(neighbours_.faces[k]);
            sum += near_[k];
        }
        means.row(f) = (sum > 0.0F ? 1.0F / sum : 0.0F) * total;
    });
}

void FaceAverages::average(float sigma, const FaceVectors& vectors, FaceVectors& means, const Executor& exec) const
{
    means.resize(n_faces(), 4);
    const float scale = 0.5F / (sigma * sigma);
    for_each(exec, n_faces(), [&](Index f) {
        const FaceVector vector = vectors.row(f);
        FaceVector total = areas_[f] * vector;
        float sum = areas_[f];
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            const FaceVector other = vectors.row(neighbours_.faces[k]);
            const float weight = near_[k] * decay(scale * (vector - other).squaredNorm());
            total += weight * other;
            sum += weight;
        }
        means.row(f) = (sum > 0.0F ? 1.0F / sum : 0.0F) * total;
    });
}

void FaceAverages::average_far(const AverageWeights& weights, const FaceVectors& vectors, FaceVectors& means,
                               std::array<FaceVectors, 2>& scratch, const Executor& exec) const
{
    // Golub and Varga, Chebyshev semi-iterative methods (1961): x⁺ = x⁻ + ω (x - x⁻ + r / d), where the eigenvalues of
    // the matrix lie between d - c and d + c.
    // t of the equation, in which `last` is the largest eigenvalue and 1 the least.
    constexpr float reach = 40.0F;
    // The eigenvalues of P are taken to lie between this and 1.
    constexpr float least_eigenvalue_of_means = -0.5F;
    constexpr int rounds = 16;
    constexpr float last = 1.0F + reach * (1.0F - least_eigenvalue_of_means);
    constexpr float d = 0.5F * (last + 1.0F);
    constexpr float c = 0.5F * (last - 1.0F);
    FaceVectors* now = scratch.data();
    FaceVectors* before = &scratch[1];
    *now = vectors;
    *before = vectors;
    means.resize(n_faces(), 4);
    float omega = 1.0F;
    for (int round = 0; round < rounds; ++round) {
        if (round > 0)
            omega = 1.0F / (1.0F - (round == 1 ? 0.5F : 0.25F * omega) * (c / d) * (c / d));
        average(weights, *now, means, exec);
        for_each(exec, n_faces(), [&](Index f) {
            const FaceVector x = now->row(f);
            const FaceVector residual = vectors.row(f) - x + reach * (means.row(f) - x);
            before->row(f) += omega * (x - before->row(f) + residual / d);
        });
        std::swap(now, before);
    }
    means = *now;
}

void FaceAverages::average_best_patch(const FaceVectors& vectors, FaceVectors& means, const Executor& exec) const
{
    // Patches whose vectors agree nearly as well as those of the best patch count, too: rounding must not decide
    // between them.
    constexpr float tie = 0.01F;
    means.resize(n_faces(), 4);
    FaceVectors of_patches(n_faces(), 4);
    std::vector<float> agreement(areas_.size());
    for_each(exec, n_faces(), [&](Index f) {
        FaceVector total = areas_[f] * vectors.row(f);
        float weight = areas_[f];
        for (const Index g : neighbours_[f]) {
            total += areas_[g] * vectors.row(g);
            weight += areas_[g];
        }
        of_patches.row(f) = (weight > 0.0F ? 1.0F / weight : 0.0F) * total;
        agreement[f] = of_patches.row(f).squaredNorm();
    });
    for_each(exec, n_faces(), [&](Index f) {
        float best = agreement[f];
        for (const Index g : neighbours_[f])
            best = std::max(best, agreement[g]);
        constexpr float inverse_tie = 1.0F / tie;
        float sum = decay(inverse_tie * (best - agreement[f]));
        FaceVector total = sum * of_patches.row(f);
        for (const Index g : neighbours_[f]) {
            const float weight = decay(inverse_tie * (best - agreement[g]));
            total += weight * of_patches.row(g);
            sum += weight;
        }
        means.row(f) = total / sum;
    });
}

std::vector<float> FaceAverages::roughness(const FaceVectors& normals, float largest, const Executor& exec) const
{
    std::vector<float> found(areas_.size());
    for_each(exec, n_faces(), [&](Index f) {
        float total = 0.0F;
        float sum = 0.0F;
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            const float squared = (normals.row(f) - normals.row(neighbours_.faces[k])).squaredNorm();
            total += near_[k] * std::min(squared, largest);
            sum += near_[k];
        }
        found[f] = sum > 0.0F ? total / sum : 0.0F;
    });
    return found;
}

void normalise(FaceVectors& vectors, const Executor& exec)
{
    for_each(exec, static_cast<Index>(vectors.rows()), [&](Index f) {
        if (const float length = vectors.row(f).norm(); length > 0.0F)
            vectors.row(f) /= length;
    });
}

}  // namespace seamflow
