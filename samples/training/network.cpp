#include "samples/training/network.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

#include "partition/errors.h"
#include "samples/training/draws.h"
#include "solvers/denoising/mixing_network.h"

namespace seamflow {

namespace {

/// A batch is divided into as many parts, whose gradients are added up in order.
constexpr int parts_of_batch = 8;
/// Of the weights of the last layer at first, compared with those of the others.
constexpr float scale_of_last = 0.3F;
/// Weights are whole numbers up to this one, times a scale.
constexpr float largest_weight = 127.0F;

class Adam {
  public:
    explicit Adam(Eigen::Index n)
        : mean_(Eigen::ArrayXf::Zero(n))
        , square_(Eigen::ArrayXf::Zero(n))
    {
    }

    void step(const Eigen::ArrayXf& gradient, float rate, Eigen::ArrayXf& parameters)
    {
        constexpr float keep_mean = 0.9F;
        constexpr float keep_square = 0.999F;
        constexpr float least = 1e-8F;
        ++n_steps_;
        mean_ = keep_mean * mean_ + (1.0F - keep_mean) * gradient;
        square_ = keep_square * square_ + (1.0F - keep_square) * gradient.square();
        const float all_of_mean = 1.0F - std::pow(keep_mean, n_steps_);
        const float all_of_square = 1.0F - std::pow(keep_square, n_steps_);
        parameters -= rate * (mean_ / all_of_mean) / ((square_ / all_of_square).sqrt() + least);
    }

  private:
    Eigen::ArrayXf mean_;
    Eigen::ArrayXf square_;
    float n_steps_ = 0.0F;
};

float activation(float x)
{
    return x > 0.0F ? x : MixingNetwork::leak * x;
}

void shuffle(std::vector<int>& order, RandomNumbers& random)
{
    for (int n = static_cast<int>(order.size()); n > 1; --n)
        std::swap(order[usize(n - 1)], order[usize(random.below(n))]);
}

template <class Numbers>
void append(std::string& bytes, const Numbers& numbers)
{
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(*numbers.data()));
}

}  // namespace

Network::Network(std::vector<int> sizes, float output, RandomNumbers& random)
    : mean_(Eigen::RowVectorXf::Zero(sizes[0]))
    , inverse_deviation_(Eigen::RowVectorXf::Ones(sizes[0]))
{
    Eigen::Index n = 0;
    for (std::size_t l = 0; l + 1 < sizes.size(); ++l) {
        layers_.push_back({sizes[l], sizes[l + 1], n});
        n += Eigen::Index{sizes[l] + 1} * sizes[l + 1];
    }
    parameters_ = Eigen::ArrayXf::Zero(n);
    for (const Layer& layer : layers_) {
        const float scale =
            (&layer == &layers_.back() ? scale_of_last : 1.0F) / std::sqrt(static_cast<float>(layer.n_inputs));
        for (float& weight : parameters_.segment(layer.first, layer.n_inputs * layer.n_outputs))
            weight = scale * static_cast<float>(normal_number(random));
    }
    parameters_.tail(layers_.back().n_outputs) = output;
}

void Network::measure(const SampleRows& inputs)
{
    constexpr double least_variance = 1e-8;
    Eigen::RowVectorXd total = Eigen::RowVectorXd::Zero(inputs.cols());
    Eigen::RowVectorXd squares = total;
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
        const Eigen::RowVectorXd row = inputs.row(i).cast<double>();
        total += row;
        squares += row.cwiseAbs2();
    }
    total /= static_cast<double>(inputs.rows());
    squares /= static_cast<double>(inputs.rows());
    mean_ = total.cast<float>();
    inverse_deviation_ =
        (squares - total.cwiseAbs2()).cwiseMax(least_variance).cwiseSqrt().cwiseInverse().cast<float>();
}

void Network::add_gradient(const SampleRows& inputs, std::span<const int> samples, const SampleLoss& loss,
                           Gradient& gradient) const
{
    const auto n = static_cast<Eigen::Index>(samples.size());
    // The inputs of each layer, then the outputs.
    std::vector<SampleRows> numbers{SampleRows(n, inputs.cols())};
    for (Eigen::Index i = 0; i < n; ++i)
        numbers[0].row(i) = (inputs.row(samples[i]) - mean_).cwiseProduct(inverse_deviation_);
    for (const Layer& layer : layers_) {
        SampleRows next = numbers.back() * layer.weights(parameters_).transpose();
        next.rowwise() += layer.bias(parameters_);
        if (&layer != &layers_.back())
            next = next.unaryExpr(&activation).eval();
        numbers.push_back(std::move(next));
    }
    const auto n_outputs = static_cast<std::size_t>(numbers.back().cols());
    SampleRows slope(n, numbers.back().cols());
    gradient.loss = 0.0F;
    for (Eigen::Index i = 0; i < n; ++i)
        gradient.loss += loss(samples[i], {&numbers.back()(i, 0), n_outputs}, {&slope(i, 0), n_outputs});
    gradient.of_parameters.resize(parameters_.size());
    for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer) {
        numbers.pop_back();
        const Eigen::Index n_weights = layer->n_inputs * layer->n_outputs;
        Eigen::Map<SampleRows>(gradient.of_parameters.data() + layer->first, layer->n_outputs, layer->n_inputs) =
            slope.transpose() * numbers.back();
        gradient.of_parameters.segment(layer->first + n_weights, layer->n_outputs) = slope.colwise().sum().array();
        slope =
            (slope * layer->weights(parameters_))
                .cwiseProduct(numbers.back().unaryExpr([](float x) { return x > 0.0F ? 1.0F : MixingNetwork::leak; }))
                .eval();
    }
}

float Network::train(const SampleRows& inputs, const SampleLoss& loss, const TrainingPlan& plan, RandomNumbers& random,
                     const Executor& exec)
{
    const auto n = static_cast<int>(inputs.rows());
    const int n_batches = n / plan.batch;
    if (n_batches == 0)
        throw OptionError("there are fewer samples than a batch has: more surfaces or more samples are needed");
    measure(inputs);
    std::vector<int> order(usize(n));
    std::iota(order.begin(), order.end(), 0);
    Adam adam(parameters_.size());
    std::vector<Gradient> parts(parts_of_batch);
    const int samples_of_part = plan.batch / parts_of_batch;
    const float n_steps = static_cast<float>(plan.epochs * n_batches);
    float mean_loss = 0.0F;
    for (int step = 0; step < plan.epochs * n_batches; ++step) {
        const int batch = step % n_batches;
        if (batch == 0) {
            shuffle(order, random);
            mean_loss = 0.0F;
        }
        for_each(exec, parts_of_batch, [&](Index part) {
            const int first = batch * plan.batch + part * samples_of_part;
            add_gradient(inputs, std::span(order).subspan(usize(first), usize(samples_of_part)), loss,
                         parts[usize(part)]);
        });
        for (std::size_t part = 1; part < parts.size(); ++part) {
            parts[0].of_parameters += parts[part].of_parameters;
            parts[0].loss += parts[part].loss;
        }
        const float of_sample = 1.0F / static_cast<float>(plan.batch);
        mean_loss += parts[0].loss * of_sample / static_cast<float>(n_batches);
        const float phase = std::numbers::pi_v<float> * static_cast<float>(step) / n_steps;
        adam.step(parts[0].of_parameters * of_sample, 0.5F * plan.rate * (1.0F + std::cos(phase)), parameters_);
    }
    return mean_loss;
}

std::string Network::bytes() const
{
    std::string bytes;
    append(bytes, std::vector{static_cast<std::int32_t>(layers_.size())});
    for (const Layer& layer : layers_) {
        const bool is_first = &layer == layers_.data();
        const auto weights = layer.weights(parameters_);
        const Eigen::VectorXf largest = weights.cwiseAbs().rowwise().maxCoeff();
        const Eigen::VectorXf scales = (largest.array() > 0.0F).select(largest / largest_weight, 1.0F);
        const SampleRows whole = (weights.array().colwise() / scales.array()).round();
        Eigen::RowVectorXf scales_of_inputs = Eigen::RowVectorXf::Ones(layer.n_inputs);
        Eigen::VectorXf bias = layer.bias(parameters_).transpose();
        if (is_first) {
            // With the rounded weights, so that rounding changes nothing at the mean of the samples.
            scales_of_inputs = inverse_deviation_;
            bias -= scales.cwiseProduct(whole * mean_.cwiseProduct(inverse_deviation_).transpose());
        }
        append(bytes,
               std::vector{static_cast<std::int32_t>(layer.n_inputs), static_cast<std::int32_t>(layer.n_outputs)});
        append(bytes, scales_of_inputs);
        append(bytes, scales);
        append(bytes, bias);
        append(bytes, Eigen::Matrix<std::int8_t, Eigen::Dynamic, Eigen::Dynamic>(whole.cast<std::int8_t>()));
    }
    return bytes;
}

}  // namespace seamflow
