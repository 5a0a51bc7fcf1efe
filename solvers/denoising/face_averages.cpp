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

/// Of the corners of a face that has no area to the precision of its coordinates.
constexpr double least_height = 1e-12;

double area_or_none(std::span<const Index> corners, const Points& positions)
{
    const double size = area(corners, positions);
    double longest = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k)
        longest = std::max(
            longest,
            (positions.row(corners[k]) - positions.row(corners[k == 0 ? corners.size() - 1 : k - 1])).squaredNorm());
    return size > least_height * longest ? size : 0.0;
}

}  // namespace

FaceAverages::FaceAverages(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
    : mesh_(&mesh)
    , neighbours_(make_face_neighbours(mesh, topology, exec))
    , signs_(face_signs(mesh, topology))
    , areas_(at(mesh.n_faces()))
    , near_(neighbours_.faces.size())
{
}

void FaceAverages::measure(const Points& positions, const Executor& exec)
{
    const Index n = n_faces();
    Points centroids(n, 3);
    std::vector<double> areas(at(n));
    for_each(exec, n, [&](Index f) {
        areas[f] = area_or_none(mesh_->face(f), positions);
        centroids.row(f) = centroid(mesh_->face(f), positions);
    });
    const double mean_area = sum(exec, n, [&](Index f) { return areas[f]; }) / std::max(n, Index{1});
    std::vector<double> reach(at(n));
    for_each(exec, n, [&](Index f) {
        areas_[f] = mean_area > 0.0 ? static_cast<float>(areas[f] / mean_area) : 0.0F;
        double squares = 0.0;
        for (const Index g : neighbours_[f])
            squares += (centroids.row(f) - centroids.row(g)).squaredNorm();
        const std::size_t count = neighbours_[f].size();
        reach[f] = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
    });
    for_each(exec, n, [&](Index f) {
        for (std::size_t k = neighbours_.offsets[f]; k < neighbours_.offsets[f + 1]; ++k) {
            const Index g = neighbours_.faces[k];
            const double squared = (centroids.row(f) - centroids.row(g)).squaredNorm();
            const double scale = reach[f] * reach[g];
            near_[k] = scale > 0.0 ? areas_[g] * decay(static_cast<float>(squared / scale)) : 0.0F;
        }
    });
}

void FaceAverages::measure_normals(const Points& positions, FaceVectors& normals, const Executor& exec) const
{
    normals.resize(n_faces(), 4);
    for_each(exec, n_faces(), [&](Index f) {
        Point normal = vector_area(mesh_->face(f), positions);
        const double length = normal.norm();
        normal *= length > 0.0 && area_or_none(mesh_->face(f), positions) > 0.0
                      ? (signs_.empty() ? 1.0 : signs_[f]) / length
                      : 0.0;
        normals.row(f) << normal.cast<float>(), 0.0F;
    });
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

void FaceAverages::average_best_patch(const FaceVectors& vectors, FaceVectors& means, const Executor& exec) const
{
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
        Index patch = f;
        for (const Index g : neighbours_[f])
            if (agreement[g] > agreement[patch])
                patch = g;
        means.row(f) = of_patches.row(patch);
    });
}

void FaceAverages::spread(Rows& near, Rows& around, int rounds, int further_rounds, const Executor& exec) const
{
    // A few columns at a time, so that they fill registers and take little memory.
    constexpr int width = 16;
    using NarrowRows = Eigen::Matrix<float, Eigen::Dynamic, width, Eigen::RowMajor>;
    NarrowRows now = NarrowRows::Zero(n_faces(), width);
    NarrowRows before(n_faces(), width);
    for (Eigen::Index first = 0; first < near.cols(); first += width) {
        const Eigen::Index n = std::min<Eigen::Index>(width, near.cols() - first);
        for_each(exec, n_faces(), [&](Index f) { now.row(f).head(n) = near.row(f).segment(first, n); });
        for (int round = 1; round <= rounds + further_rounds; ++round) {
            now.swap(before);
            for_each(exec, n_faces(), [&](Index f) {
                Eigen::Matrix<float, 1, width> total = before.row(f);
                for (const Index g : neighbours_[f])
                    total += before.row(g);
                now.row(f) = total * (1.0F / static_cast<float>(1 + neighbours_[f].size()));
            });
            if (round == rounds)
                for_each(exec, n_faces(), [&](Index f) { near.row(f).segment(first, n) = now.row(f).head(n); });
        }
        for_each(exec, n_faces(), [&](Index f) { around.row(f).segment(first, n) = now.row(f).head(n); });
    }
}

void normalise(FaceVectors& vectors, const Executor& exec)
{
    for_each(exec, static_cast<Index>(vectors.rows()), [&](Index f) {
        if (const float length = vectors.row(f).norm(); length > 0.0F)
            vectors.row(f) /= length;
    });
}

}  // namespace seamflow
