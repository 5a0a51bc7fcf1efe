#include "samples/training/denoiser_training.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <utility>

#include "partition/metrics/vertex_normals.h"
#include "partition/topology.h"
#include "samples/training/draws.h"
#include "samples/training/noise.h"
#include "solvers/denoising/estimate_features.h"
#include "solvers/denoising/mixing_network.h"
#include "solvers/denoising/normal_estimates.h"
#include "solvers/normals/vertex_fit.h"

namespace seamflow {

namespace {

/// Neurons of a hidden layer of the networks that mix, and of that which gives the noise.
constexpr int mixing_width = 64;
constexpr int noise_width = 32;

/// What draws are for.
enum class Purpose : std::uint32_t { Noise = 1, NoiseAlone, Samples, NoiseSamples, Weights, NoiseWeights };

RandomNumbers numbers_for(const DenoiserTraining& training, Purpose purpose, std::size_t object)
{
    const std::uint32_t bits = mixed_bits(training.seed, static_cast<std::uint32_t>(purpose));
    return RandomNumbers(mixed_bits(bits, static_cast<std::uint32_t>(object)));
}

/// A surface, the noisy one, and how far the denoiser has come with it.
struct TrainingCase {
    PolygonMesh surface;
    Topology topology;
    /// #F: those to find.
    FaceVectors normals;
    Points noisy;
    /// #F: the result of the stages that are trained; empty before the first.
    FaceVectors found;
    /// How much each sample of the surface counts.
    float weight = 1.0F;
};

/// What a stage sees of a case.
struct StageInputs {
    NormalEstimates estimates;
    EstimateFeatures features;
};

/// The same as denoise_normals makes of it.
StageInputs inputs_of_stage(const TrainingCase& item)
{
    constexpr double relaxation_between = 0.1;
    constexpr int relaxing_rounds_between = 5;
    constexpr int plain_rounds_between = 8;
    NormalEstimator estimator(item.surface, item.topology);
    estimator.begin(item.noisy);
    StageInputs inputs;
    if (item.found.rows() == 0)
        estimator.first(inputs.estimates);
    else {
        const Points normals = item.found.leftCols<3>().cast<double>();
        Points fitted = item.noisy;
        fit_vertices(item.surface, item.topology, {},
                     {normals, relaxation_between, relaxing_rounds_between, plain_rounds_between}, fitted);
        estimator.refine(fitted);
        estimator.further(item.found, inputs.estimates);
    }
    inputs.features.measure(inputs.estimates, estimator.vertex_averages());
    return inputs;
}

/// Surfaces on which the best single estimate is good count more, so that all matter about as much.
float weight_of_case(const NormalEstimates& estimates, const FaceVectors& normals)
{
    constexpr float weight = 0.1F;
    constexpr float least_error = 0.03F;
    float best = std::numeric_limits<float>::max();
    for (FaceVectors estimate : estimates.vectors) {
        normalise(estimate);
        best = std::min(best, (estimate - normals).rowwise().norm().mean());
    }
    return weight / (best + least_error);
}

/// Whether a triangle is high enough, compared with its longest side, that its normal means something.
bool is_useful(const PolygonMesh& mesh, Index f)
{
    constexpr double least_height = 0.12;
    const auto corners = mesh.face(f);
    double longest = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index next = corners[(k + 1) % corners.size()];
        longest = std::max(longest, (mesh.vertices.row(next) - mesh.vertices.row(corners[k])).squaredNorm());
    }
    return 2.0 * vector_area(corners, mesh.vertices).norm() >= least_height * longest;
}

/// Faces of all surfaces, as one stage sees them.
struct MixingSamples {
    SampleRows inputs;
    /// Directions of the estimates, one after the other.
    std::vector<FaceVector> directions;
    std::vector<FaceVector> normals;
    std::vector<float> weights;

    /// A smooth chord between the mix and the true normal, and a little for a mix whose length is not 1.
    float loss(Eigen::Index sample, std::span<const float> outputs, std::span<float> gradient) const
    {
        constexpr float smoothing = 4e-6F;
        constexpr float least_length = 1e-6F;
        constexpr float of_length = 0.02F;
        const auto n = static_cast<Eigen::Index>(outputs.size());
        const FaceVector* const direction = &directions[static_cast<std::size_t>(sample * n)];
        FaceVector mix = FaceVector::Zero();
        for (Eigen::Index k = 0; k < n; ++k)
            mix += outputs[k] * direction[k];
        const float length = std::max(mix.norm(), least_length);
        const FaceVector unit = mix / length;
        const FaceVector difference = unit - normals[sample];
        const float chord = std::sqrt(difference.squaredNorm() + smoothing);
        const FaceVector by_unit = difference / chord;
        const FaceVector by_mix = (by_unit - unit * unit.dot(by_unit)) / length + of_length * (length - 1.0F) * unit;
        for (Eigen::Index k = 0; k < n; ++k)
            gradient[k] = weights[sample] * by_mix.dot(direction[k]);
        return weights[sample] * chord;
    }
};

MixingSamples mixing_samples(std::vector<TrainingCase>& cases, const DenoiserTraining& training, std::size_t stage,
                             const Executor& exec)
{
    const std::size_t per_case = usize(training.samples_per_surface);
    const std::size_t n = cases.size() * per_case;
    const StageInputs first = inputs_of_stage(cases[0]);
    const std::size_t n_estimates = first.estimates.vectors.size();
    std::vector<FaceVector> directions(n_estimates);
    std::vector<float> numbers;
    append_mixing_inputs(first.estimates, first.features, 0, directions, numbers);
    MixingSamples samples{SampleRows(n, numbers.size()), std::vector<FaceVector>(n * n_estimates),
                          std::vector<FaceVector>(n), std::vector<float>(n)};
    for_each(exec, static_cast<Index>(cases.size()), [&](Index c) {
        TrainingCase& item = cases[c];
        RandomNumbers random = numbers_for(training, Purpose::Samples, stage * cases.size() + usize(c));
        const StageInputs inputs = inputs_of_stage(item);
        if (stage == 0)
            item.weight = weight_of_case(inputs.estimates, item.normals);
        std::vector<float> row;
        for (std::size_t k = 0; k < per_case; ++k) {
            const std::size_t sample = usize(c) * per_case + k;
            const Index f = random.below(item.surface.n_faces());
            row.clear();
            append_mixing_inputs(inputs.estimates, inputs.features, f,
                                 std::span(samples.directions).subspan(sample * n_estimates, n_estimates), row);
            samples.inputs.row(static_cast<Eigen::Index>(sample)) =
                Eigen::Map<const Eigen::RowVectorXf>(row.data(), samples.inputs.cols());
            samples.normals[sample] = item.normals.row(f);
            samples.weights[sample] = is_useful(item.surface, f) ? item.weight : 0.0F;
        }
    });
    return samples;
}

/// Trains the next stage, and lets all cases go through it.
std::string train_stage(std::vector<TrainingCase>& cases, const DenoiserTraining& training, std::size_t stage,
                        std::ostream& out, const Executor& exec)
{
    const MixingSamples samples = mixing_samples(cases, training, stage, exec);
    const auto n_inputs = static_cast<int>(samples.inputs.cols());
    const auto n_estimates = static_cast<int>(samples.directions.size() / samples.normals.size());
    RandomNumbers random = numbers_for(training, Purpose::Weights, stage);
    Network network({n_inputs, mixing_width, mixing_width, n_estimates}, 1.0F / static_cast<float>(n_estimates),
                    random);
    const auto loss = [&](Eigen::Index sample, std::span<const float> outputs, std::span<float> gradient) {
        return samples.loss(sample, outputs, gradient);
    };
    const float mean_loss = network.train(samples.inputs, loss, {.epochs = training.epochs}, random, exec);
    std::string bytes = network.bytes();
    const MixingNetwork mixing(bytes);
    for_each(exec, static_cast<Index>(cases.size()), [&](Index c) {
        const StageInputs inputs = inputs_of_stage(cases[c]);
        cases[c].found = mixing.mix(inputs.estimates, inputs.features);
    });
    double error = 0.0;
    for (const TrainingCase& item : cases)
        error += (item.found - item.normals).rowwise().norm().mean() / static_cast<double>(cases.size());
    out << "stage " << stage + 1 << ": loss " << mean_loss << ", mean chord to the true normals " << error << std::endl;
    return bytes;
}

/// #F: the logarithm of the noise around each face, in lengths of its edges.
SampleRows log_noise(const TrainingCase& item, const VertexAverages& averages)
{
    constexpr float most_squared = 4.0F;
    constexpr float least_noise = 0.004F;
    constexpr int rounds = 24;
    const Points& clean = item.surface.vertices;
    const VertexNormals normals(item.surface, item.topology);
    SampleRows squares(item.surface.n_faces(), 1);
    for (Index f = 0; f < item.surface.n_faces(); ++f) {
        const auto corners = item.surface.face(f);
        double distances = 0.0;
        double lengths = 0.0;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const Index v = corners[k];
            const double distance = (item.noisy.row(v) - clean.row(v)).dot(normals(v, clean));
            distances += distance * distance;
            lengths += (clean.row(corners[(k + 1) % corners.size()]) - clean.row(v)).squaredNorm();
        }
        squares(f, 0) = lengths > 0.0 ? std::min(static_cast<float>(distances / lengths), most_squared) : 0.0F;
    }
    SampleRows around(squares.rows(), 1);
    averages.spread(squares, around, 0, rounds);
    return (around.array().sqrt() + least_noise).log();
}

/// Trains the network that gives the noise, with new noise.
std::string train_noise(std::vector<TrainingCase>& cases, const DenoiserTraining& training, std::ostream& out,
                        const Executor& exec)
{
    constexpr int draws_per_case = 3;
    constexpr int samples_per_draw = 80;
    constexpr int one_without_noise = 11;
    constexpr TrainingPlan plan{.epochs = 20, .batch = 256, .rate = 3e-3F};
    constexpr float first_output = -2.0F;
    constexpr std::size_t per_case = std::size_t{draws_per_case} * samples_per_draw;
    std::vector<SampleRows> inputs_of_case(cases.size());
    std::vector<float> wanted(cases.size() * per_case);
    for_each(exec, static_cast<Index>(cases.size()), [&](Index c) {
        TrainingCase& item = cases[c];
        item.found.resize(0, item.found.cols());
        RandomNumbers random = numbers_for(training, Purpose::NoiseAlone, usize(c));
        for (int draw = 0; draw < draws_per_case; ++draw) {
            item.noisy = (c + draw) % one_without_noise == 0
                             ? item.surface.vertices
                             : add_noise(item.surface, item.topology, NoiseRange::ForNoise, random);
            const StageInputs inputs = inputs_of_stage(item);
            const SampleRows logarithms = log_noise(item, VertexAverages(item.surface, item.topology));
            inputs_of_case[c].conservativeResize(per_case, inputs.features.around.cols());
            for (int k = draw * samples_per_draw; k < (draw + 1) * samples_per_draw; ++k) {
                const Index f = random.below(item.surface.n_faces());
                inputs_of_case[c].row(k) = inputs.features.around.row(f);
                wanted[usize(c) * per_case + usize(k)] = logarithms(f, 0);
            }
        }
    });
    SampleRows inputs(wanted.size(), inputs_of_case[0].cols());
    for (std::size_t c = 0; c < cases.size(); ++c)
        inputs.middleRows(static_cast<Eigen::Index>(c * per_case), per_case) = inputs_of_case[c];
    RandomNumbers random = numbers_for(training, Purpose::NoiseWeights, 0);
    Network network({static_cast<int>(inputs.cols()), noise_width, 1}, first_output, random);
    // The absolute error, rounded off at 0 (Huber, 1964).
    const auto loss = [&](Eigen::Index sample, std::span<const float> outputs, std::span<float> gradient) {
        constexpr float rounded = 0.1F;
        const float error = outputs[0] - wanted[sample];
        gradient[0] = std::clamp(error / rounded, -1.0F, 1.0F);
        return std::abs(error);
    };
    const float mean_loss = network.train(inputs, loss, plan, random, exec);
    out << "noise: mean error of its logarithm " << mean_loss << std::endl;
    return network.bytes();
}

}  // namespace

TrainedDenoiser train_denoiser(std::vector<PolygonMesh> surfaces, const DenoiserTraining& training, std::ostream& out,
                               const Executor& exec)
{
    std::vector<TrainingCase> cases(surfaces.size());
    for_each(exec, static_cast<Index>(cases.size()), [&](Index c) {
        TrainingCase& item = cases[c];
        item.surface = std::move(surfaces[c]);
        item.topology = make_topology(item.surface);
        FaceAverages(item.surface, item.topology).measure_normals(item.surface.vertices, item.normals);
        RandomNumbers random = numbers_for(training, Purpose::Noise, usize(c));
        item.noisy = add_noise(item.surface, item.topology, NoiseRange::ForNormals, random);
    });
    TrainedDenoiser trained;
    for (int stage = 0; stage < training.n_stages; ++stage)
        trained.stages.push_back(train_stage(cases, training, usize(stage), out, exec));
    trained.noise = train_noise(cases, training, out, exec);
    return trained;
}

}  // namespace seamflow
