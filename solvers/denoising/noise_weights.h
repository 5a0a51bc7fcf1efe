#pragma once

#include <array>

namespace seamflow {

/// Of a logistic regression: what each of the noise_features adds to the logarithm of the odds.
struct NoiseWeights {
    float constant = 0.0F;
    std::array<float, 8> of_features{};
};

// Written by samples/training/fit_noise.py.
inline constexpr NoiseWeights weights_of_noise{8.105F,
                                               {0.8518F, -8.979F, -9.817F, 1.253F, 0.0F, -3.744F, -0.3592F, 1.664F}};
inline constexpr NoiseWeights weights_of_alike_noise{
    8.442F, {0.8331F, 0.0F, -3.016F, 0.5443F, -0.3834F, -1.345F, -5.887F, 0.2786F}};
inline constexpr NoiseWeights weights_of_alike_against_independent_noise{
    -2.048F, {-0.4613F, 9.537F, 21.59F, -1.179F, -1.454F, 7.468F, -1.519F, -3.007F}};

}  // namespace seamflow
