#include "solvers/denoising/noise_evidence.h"

#include <algorithm>
#include <cmath>

#include "solvers/denoising/noise_weights.h"

namespace seamflow {

namespace {

/// Added before logarithms are taken, to numbers in edge lengths and to the kurtosis.
constexpr float added_to_length = 0.001F;
constexpr float added_to_kurtosis = 0.5F;
/// Smoothness is clamped to these bounds, and correlations are at least this: values beyond do not help to decide.
constexpr float most_smoothness = 3.0F;
constexpr float least_smoothness = -0.5F;
constexpr float least_correlation = -0.05F;
/// The revivals (see RemovalStatistics::revival) below which a revival is no evidence for shape: of the
/// displacements that the denoiser removes, and of those that a low-pass filter removes. Independent noise is below the
/// first at 99 of 100 places, and below the second at 90 of 100.
constexpr float revival_of_noise = 0.35F;
constexpr float wide_revival_of_noise = 0.6F;

/// The logarithm of the odds at a place, by a logistic regression.
float evidence(const NoiseWeights& weights, const PlaceStatistics& place)
{
    const auto features = features_of(place);
    float total = weights.constant;
    for (std::size_t i = 0; i < features.size(); ++i)
        total += weights.of_features[i] * features[i];
    return total;
}

}  // namespace

std::array<float, noise_features.size()> features_of(const PlaceStatistics& place)
{
    const auto log_length = [](float length) { return std::log(length + added_to_length); };
    return {log_length(place.fine.median),
            std::max(place.fine.correlation, least_correlation),
            std::max(place.fine.revival - revival_of_noise, 0.0F),
            log_length(place.noise),
            std::clamp(place.smoothness, least_smoothness, most_smoothness),
            place.wide.correlation,
            std::max(place.wide.revival - wide_revival_of_noise, 0.0F),
            std::log(place.wide.kurtosis + added_to_kurtosis)};
}

float evidence_of_noise(const PlaceStatistics& place)
{
    return evidence(weights_of_independent_noise, place);
}

float evidence_of_correlated_noise(const PlaceStatistics& place)
{
    return evidence(weights_of_correlated_noise, place);
}

float evidence_against_independent_noise(const PlaceStatistics& place)
{
    return evidence(weights_of_correlated_against_independent_noise, place);
}

}  // namespace seamflow
