#pragma once

#include <string_view>
#include <vector>

#include "partition/executor.h"
#include "solvers/denoising/estimate_features.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/normal_estimates.h"

namespace seamflow {

/// A network with two hidden layers, which says how much each of several estimates counts at a face. Its weights were
/// learned from surfaces that are known (see samples/training).
class MixingNetwork {
  public:
    /// Of the side of an activation below 0.
    static constexpr float leak = 0.1F;

    /// @param bytes its weights (see mixing_weights.h).
    explicit MixingNetwork(std::string_view bytes);

    /// The mix of the estimates at each face: of length 1, or 0 where the first estimate is 0.
    [[nodiscard]] FaceVectors mix(const NormalEstimates& estimates, const EstimateFeatures& features,
                                  const Executor& exec = run_serially) const;

    /// #F: the number that a network of the features `around` alone gives.
    [[nodiscard]] std::vector<float> apply(const EstimateFeatures& features, const Executor& exec = run_serially) const;

  private:
    struct Layer {
        int n_inputs = 0;
        int n_outputs = 0;
        /// Row i: the weights of input i.
        std::vector<float> weights;
        std::vector<float> bias;
    };

    /// Replaces the inputs of some faces, one after the other, by the outputs.
    void evaluate(std::vector<float>& numbers) const;

    std::vector<Layer> layers_;
};

}  // namespace seamflow
