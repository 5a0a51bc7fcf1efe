#pragma once

#include <array>

namespace seamflow {

/// Of a logistic regression: what each of the noise_features adds to the logarithm of the odds.
struct NoiseWeights {
    float constant = 0.0F;
    std::array<float, 8> of_features{};
};

// Written by samples/training/fit_noise.py.
inline constexpr NoiseWeights weights_of_noise{
    7.835F, {0.7461F, -7.567F, -7.349F, 1.431F, 0.0F, -4.101F, -0.3731F, 1.721F}};
inline constexpr NoiseWeights weights_of_alike_noise{
    7.595F, {0.5887F, 0.0F, -2.508F, 0.5538F, -0.5689F, -1.006F, -6.188F, 0.0F}};
inline constexpr NoiseWeights weights_of_alike_against_independent_noise{
    -1.61F, {-0.5427F, 6.796F, 21.17F, -1.257F, -1.665F, 7.941F, 2.081F, -3.61F}};

}  // namespace seamflow
