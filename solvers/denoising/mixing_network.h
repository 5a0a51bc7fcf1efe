#pragma once

#include <string_view>
#include <vector>

#include "partition/executor.h"
#include "solvers/denoising/estimate_features.h"
#include "solvers/denoising/face_averages.h"
#include "solvers/denoising/normal_estimates.h"

namespace seamflow {

/// A network with two hidden layers, which computes the weight of each of several estimates at a face. Its own weights
/// were learned from surfaces whose true shape is known (see samples/training).
class MixingNetwork {
  public:
    /// The slope of the activation function below 0.
    static constexpr float leak = 0.1F;

    /// @param bytes the weights of the network (see mixing_weights.h).
    explicit MixingNetwork(std::string_view bytes);

    /// The weighted sum of the estimates at each face, scaled to length 1. Where the sum is 0: the first estimate,
    /// scaled to length 1, or 0 if it is 0.
    [[nodiscard]] FaceVectors mix(const NormalEstimates& estimates, const EstimateFeatures& features,
                                  const Executor& exec = run_serially) const;

    /// #F: the output of a network with one output, whose inputs are the features `around` alone.
    [[nodiscard]] std::vector<float> apply(const EstimateFeatures& features, const Executor& exec = run_serially) const;

  private:
    struct Layer {
        int n_inputs = 0;
        /// Rounded up to a multiple of 32; further outputs are 0 and not used. Layers before the last have such a
        /// number.
        int n_outputs = 0;
        /// Row i has the weights of input i.
        std::vector<float> weights;
        std::vector<float> bias;
    };

    /// Replaces the inputs of a few faces that are evaluated together, one face after the other, by the outputs of the
    /// last layer.
    void evaluate(std::vector<float>& numbers) const;

    std::vector<Layer> layers_;
};

}  // namespace seamflow
