#pragma once

#include <array>
#include <string_view>

#include "solvers/denoising/place_statistics.h"

namespace seamflow {

/// The names of the features by which noise and shape are distinguished. Names with wide_ are those of
/// PlaceStatistics::wide; median, correlation and revival are those of PlaceStatistics::fine.
inline constexpr std::array<std::string_view, 8> noise_features{
    "median", "correlation", "revival", "noise", "smoothness", "wide_correlation", "wide_revival", "wide_kurtosis"};

/// The features of a place: medians, kurtosis and noise as logarithms, revivals as the excess over the revivals of
/// noise.
std::array<float, noise_features.size()> features_of(const PlaceStatistics& place);

/// The logarithm of the odds that the displacement which the denoiser would remove at a place is noise and not shape: a
/// logistic regression on places of surfaces whose true shape is known (see samples/training/noise_or_shape.md).
float evidence_of_noise(const PlaceStatistics& place);

/// The logarithm of the odds of correlated noise, such as that of many scanners, against shape.
float evidence_of_correlated_noise(const PlaceStatistics& place);

/// The logarithm of the odds of correlated noise against independent noise, which the denoiser removes completely.
float evidence_against_independent_noise(const PlaceStatistics& place);

}  // namespace seamflow
