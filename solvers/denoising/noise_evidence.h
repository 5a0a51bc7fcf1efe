#pragma once

#include <array>
#include <string_view>

#include "solvers/denoising/place_statistics.h"

namespace seamflow {

/// The numbers by which noise is told from shape.
inline constexpr std::array<std::string_view, 8> noise_features{
    "median", "correlation", "revival", "noise", "smoothness", "wide_correlation", "wide_revival", "wide_kurtosis"};

/// Medians, kurtosis and noise as logarithms; of revivals what is more than those of noise.
std::array<float, noise_features.size()> features_of(const PlaceStatistics& place);

/// The logarithm of the odds that what the denoiser takes away at a place is noise, against shape: a logistic
/// regression on places of surfaces that are known (see samples/training/noise_or_shape.md).
float evidence_of_noise(const PlaceStatistics& place);

/// The same for noise that is alike at neighbours, as that of many scanners.
float evidence_of_alike_noise(const PlaceStatistics& place);

/// Of noise that is alike at neighbours, against noise that is independent there, of which the denoiser takes all.
float evidence_against_independent_noise(const PlaceStatistics& place);

}  // namespace seamflow
