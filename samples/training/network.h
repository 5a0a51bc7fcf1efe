#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "partition/executor.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

/// One row per sample.
using SampleRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The loss of one sample for the outputs of a network, and its derivatives by them.
using SampleLoss = std::function<float(Eigen::Index sample, std::span<const float> outputs, std::span<float> gradient)>;

/// How a network is trained.
struct TrainingPlan {
    int epochs = 9;
    /// Samples in a step.
    int batch = 1'024;
    /// Of the first steps; falls to 0 like a cosine (Loshchilov, Hutter, SGDR, 2017).
    float rate = 2e-3F;
};

/// A network of layers with leaky activations between them (see MixingNetwork), which can learn.
class Network {
  public:
    /// @param sizes the numbers of inputs, of each hidden layer, and of outputs. @param output what all outputs are
    /// about, before training.
    Network(std::vector<int> sizes, float output, RandomNumbers& random);

    /// Makes the mean loss of the samples small (Kingma, Ba, Adam, 2015). Bits do not depend on how loops are run.
    /// @param inputs #samples by #inputs. @returns the mean loss in the last epoch.
    float train(const SampleRows& inputs, const SampleLoss& loss, const TrainingPlan& plan, RandomNumbers& random,
                const Executor& exec);

    /// The weights, rounded, as MixingNetwork reads them (see mixing_weights.h).
    [[nodiscard]] std::string bytes() const;

  private:
    struct Layer {
        Eigen::Index n_inputs;
        Eigen::Index n_outputs;
        /// Where its weights, an output a row, begin in the parameters; the biases follow.
        Eigen::Index first;

        [[nodiscard]] Eigen::Map<const SampleRows> weights(const Eigen::ArrayXf& parameters) const
        {
            return {parameters.data() + first, n_outputs, n_inputs};
        }
        [[nodiscard]] Eigen::Map<const Eigen::RowVectorXf> bias(const Eigen::ArrayXf& parameters) const
        {
            return {parameters.data() + first + n_outputs * n_inputs, n_outputs};
        }
    };

    /// Of the samples of part of a batch.
    struct Gradient {
        Eigen::ArrayXf of_parameters;
        float loss = 0.0F;
    };

    void measure(const SampleRows& inputs);
    void add_gradient(const SampleRows& inputs, std::span<const int> samples, const SampleLoss& loss,
                      Gradient& gradient) const;

    std::vector<Layer> layers_;
    Eigen::ArrayXf parameters_;
    /// By which inputs are standardised.
    Eigen::RowVectorXf mean_;
    Eigen::RowVectorXf inverse_deviation_;
};

}  // namespace seamflow
