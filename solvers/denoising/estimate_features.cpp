#include "solvers/denoising/estimate_features.h"

#include <algorithm>
#include <cmath>

namespace seamflow {

namespace {

constexpr int near_rounds = 5;
constexpr int further_rounds = 18;
/// Added to numbers before their logarithms are taken, and to the chord of noise by which chords are divided.
constexpr float least_feature = 0.004F;
constexpr float least_chord = 0.01F;
/// A number x of several times the noise is reduced to x / (1 + x / 4).
constexpr float large_part = 0.25F;

/// The square root of how much shorter than 1 a vector is. It is about proportional to the angle between the averaged
/// vectors.
float shortness(float length)
{
    return std::sqrt(std::max(0.0F, 1.0F - length));
}

FaceVector direction(const FaceVector& vector)
{
    const float length = vector.norm();
    return length > 0.0F ? FaceVector(vector / length) : FaceVector(FaceVector::Zero());
}

}  // namespace

void EstimateFeatures::measure(const NormalEstimates& estimates, const VertexAverages& averages, const Executor& exec)
{
    const auto n_faces = static_cast<Index>(estimates.vectors.front().rows());
    const auto n_estimates = static_cast<Index>(estimates.vectors.size());
    near.resize(n_faces, 2 * n_estimates - 1);
    for_each(exec, n_faces, [&](Index f) {
        FaceVector before = FaceVector::Zero();
        for (Index k = 0; k < n_estimates; ++k) {
            const FaceVector vector = estimates.vectors[k].row(f);
            const FaceVector unit = direction(vector);
            near(f, k) = shortness(vector.norm());
            if (k > 0)
                near(f, n_estimates + k - 1) = (unit - before).norm();
            before = unit;
        }
    });
    around.resize(near.rows(), near.cols());
    averages.spread(near, around, near_rounds, further_rounds, exec);
    for_each(exec, n_faces, [&](Index f) {
        near.row(f) = (near.row(f).array() + least_feature).log();
        around.row(f) = (around.row(f).array() + least_feature).log();
    });
}

void append_mixing_inputs(const NormalEstimates& estimates, const EstimateFeatures& features, Index f,
                          std::span<FaceVector> directions, std::vector<float>& numbers)
{
    const auto n_estimates = static_cast<Index>(estimates.vectors.size());
    for (Index i = 0; i < static_cast<Index>(features.near.cols()); ++i) {
        numbers.push_back(features.near(f, i));
        numbers.push_back(features.around(f, i));
    }
    // The mean chord between the first two estimates is the unit of the noise. It is recovered from its logarithm.
    const float chord = std::exp(features.around(f, n_estimates)) - least_feature;
    const float scale = 1.0F / (chord + least_chord);
    for (Index i = 0; i < n_estimates; ++i) {
        const FaceVector vector = estimates.vectors[i].row(f);
        directions[i] = direction(vector);
        numbers.push_back(scale * shortness(vector.norm()));
    }
    for (Index i = 0; i < n_estimates; ++i)
        for (const int anchor : estimates.anchors) {
            const float number = scale * (directions[i] - directions[anchor]).norm();
            numbers.push_back(number / (1.0F + large_part * number));
        }
}

}  // namespace seamflow
