#include "solvers/denoising/mixing_network.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "solvers/direct/simd.h"

namespace seamflow {

namespace {

/// Two faces are evaluated at a time, so that the loaded weights are used twice.
constexpr Index faces_at_once = 2;
/// The number of outputs of a layer that are computed together.
constexpr Index outputs_at_once = 32;

struct MultiplyKernel {
    /// y = W x + b for some faces.
    template <Index Width>
    [[gnu::always_inline]] void operator()(SimdWidth<Width>, const float* weights, const float* bias, Index n_inputs,
                                           Index n_outputs, const float* inputs, float* outputs) const
    {
        using Outputs = SimdBlock<float, Width, outputs_at_once>;
        for (Index first = 0; first < n_outputs; first += outputs_at_once) {
            Outputs sums[faces_at_once];
            for (Outputs& block : sums)
                block.load_from(bias + first);
            for (Index i = 0; i < n_inputs; ++i) {
                Outputs row;
                row.load_from(weights + i * n_outputs + first);
                for (Index k = 0; k < faces_at_once; ++k)
                    sums[k].add_product(inputs[k * n_inputs + i], row);
            }
            for (Index k = 0; k < faces_at_once; ++k)
                for (Index p = 0; p < Outputs::n_registers; ++p)
                    store(sums[k].registers[p], outputs + k * n_outputs + first + p * Outputs::lanes_of_register);
        }
    }
};

/// Removes the first n numbers from bytes and returns them.
template <class Number>
std::vector<Number> take(std::string_view& bytes, std::size_t n)
{
    std::vector<Number> numbers(n);
    std::memcpy(numbers.data(), bytes.data(), n * sizeof(Number));
    bytes.remove_prefix(n * sizeof(Number));
    return numbers;
}

}  // namespace

MixingNetwork::MixingNetwork(std::string_view bytes)
{
    const int n_layers = take<std::int32_t>(bytes, 1)[0];
    for (int l = 0; l < n_layers; ++l) {
        const std::vector<std::int32_t> sizes = take<std::int32_t>(bytes, 2);
        Layer layer;
        layer.n_inputs = sizes[0];
        layer.n_outputs = (sizes[1] + outputs_at_once - 1) / outputs_at_once * outputs_at_once;
        const std::vector<float> scales_of_inputs = take<float>(bytes, usize(sizes[0]));
        const std::vector<float> scales = take<float>(bytes, usize(sizes[1]));
        const std::vector<float> bias = take<float>(bytes, usize(sizes[1]));
        const std::vector<std::int8_t> weights = take<std::int8_t>(bytes, usize(sizes[0]) * usize(sizes[1]));
        layer.weights.assign(usize(layer.n_inputs) * usize(layer.n_outputs), 0.0F);
        layer.bias.assign(usize(layer.n_outputs), 0.0F);
        for (int j = 0; j < sizes[1]; ++j) {
            layer.bias[usize(j)] = bias[usize(j)];
            for (int i = 0; i < sizes[0]; ++i)
                layer.weights[usize(i * layer.n_outputs + j)] = static_cast<float>(weights[usize(i * sizes[1] + j)]) *
                                                                scales[usize(j)] * scales_of_inputs[usize(i)];
        }
        layers_.push_back(std::move(layer));
    }
}

void MixingNetwork::evaluate(std::vector<float>& numbers) const
{
    std::vector<float> outputs;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
        const Layer& layer = layers_[l];
        outputs.resize(usize(faces_at_once) * usize(layer.n_outputs));
        with_simd_width(register_width(), MultiplyKernel(), layer.weights.data(), layer.bias.data(),
                        Index{layer.n_inputs}, Index{layer.n_outputs}, numbers.data(), outputs.data());
        if (l + 1 < layers_.size())
            for (float& number : outputs)
                number = number > 0.0F ? number : leak * number;
        numbers.swap(outputs);
    }
}

FaceVectors MixingNetwork::mix(const NormalEstimates& estimates, const EstimateFeatures& features,
                               const Executor& exec) const
{
    const auto n = static_cast<Index>(features.near.rows());
    const auto n_estimates = static_cast<Index>(estimates.vectors.size());
    FaceVectors mixed(n, 4);
    const Index n_groups = (n + faces_at_once - 1) / faces_at_once;
    exec(n_groups, [&](Index begin, Index end) {
        std::vector<FaceVector> units(usize(faces_at_once * n_estimates));
        std::vector<float> numbers;
        for (Index group = begin; group < end; ++group) {
            numbers.clear();
            for (Index k = 0; k < faces_at_once; ++k) {
                // The last group is filled up with the last face, whose further results are not used.
                const Index f = std::min(group * faces_at_once + k, n - 1);
                append_mixing_inputs(estimates, features, f,
                                     std::span(units).subspan(usize(k * n_estimates), usize(n_estimates)), numbers);
            }
            evaluate(numbers);
            const auto n_outputs = static_cast<Index>(numbers.size()) / faces_at_once;
            for (Index k = 0; k < faces_at_once; ++k) {
                const Index f = group * faces_at_once + k;
                if (f >= n)
                    break;
                FaceVector total = FaceVector::Zero();
                for (Index i = 0; i < n_estimates; ++i)
                    total += numbers[k * n_outputs + i] * units[k * n_estimates + i];
                const float length = total.norm();
                mixed.row(f) = length > 0.0F ? FaceVector(total / length) : units[k * n_estimates];
            }
        }
    });
    return mixed;
}

std::vector<float> MixingNetwork::apply(const EstimateFeatures& features, const Executor& exec) const
{
    const auto n = static_cast<Index>(features.around.rows());
    std::vector<float> results(usize(n));
    const Index n_groups = (n + faces_at_once - 1) / faces_at_once;
    exec(n_groups, [&](Index begin, Index end) {
        std::vector<float> numbers;
        for (Index group = begin; group < end; ++group) {
            numbers.clear();
            for (Index k = 0; k < faces_at_once; ++k) {
                // The last group is filled up with the last face, whose further results are not used.
                const Index f = std::min(group * faces_at_once + k, n - 1);
                for (Index i = 0; i < static_cast<Index>(features.around.cols()); ++i)
                    numbers.push_back(features.around(f, i));
            }
            evaluate(numbers);
            for (Index k = 0; k < faces_at_once && group * faces_at_once + k < n; ++k)
                results[group * faces_at_once + k] = numbers[k * (numbers.size() / faces_at_once)];
        }
    });
    return results;
}

}  // namespace seamflow
