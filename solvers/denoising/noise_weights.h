#pragma once

#include <array>

namespace seamflow {

/// The weights of a logistic regression: the contribution of each of the noise_features to the logarithm of the odds.
struct NoiseWeights {
    float constant = 0.0F;
    std::array<float, 8> of_features{};
};

// Written by samples/training/fit_noise.py.
inline constexpr NoiseWeights weights_of_independent_noise{
    7.831F, {1.205F, -10.46F, -8.36F, 0.9571F, 0.0F, -1.514F, -1.143F, 1.822F}};
inline constexpr NoiseWeights weights_of_correlated_noise{
    8.238F, {0.6975F, 0.0F, -4.164F, 0.6127F, -0.451F, -1.551F, -4.548F, 0.06228F}};
inline constexpr NoiseWeights weights_of_correlated_against_independent_noise{
    -2.792F, {-0.1479F, 9.791F, 10.05F, -1.812F, -1.834F, 4.583F, -0.5475F, -1.971F}};

}  // namespace seamflow
