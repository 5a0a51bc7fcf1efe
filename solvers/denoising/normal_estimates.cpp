#include "solvers/denoising/normal_estimates.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace seamflow {

namespace {

// All rounds and widths were chosen together with the networks that mix the estimates (see mixing_network.h); with
// other networks they would not fit.

/// The rounds of low-pass filters of positions, and of robust ones. The normals of the filtered surfaces are estimates.
const std::vector<int> rounds_of_positions{2, 3, 4, 8, 16};
const std::vector<int> rounds_of_robust_positions{3, 6};
/// The index in rounds_of_positions of the surface from which the robust filter measures distances.
constexpr std::size_t index_of_surface = 2;

/// Replaces the vectors of a list one after the other, and appends more.
class Writer {
  public:
    explicit Writer(NormalEstimates& estimates)
        : vectors_(&estimates.vectors)
    {
    }

    /// The next vectors of the list, to be overwritten; appended if there are none.
    FaceVectors& next()
    {
        if (count_ == vectors_->size())
            vectors_->emplace_back();
        return (*vectors_)[count_++];
    }

    void copy(const FaceVectors& vectors) { next() = vectors; }

    void copy(const std::vector<FaceVectors>& list)
    {
        for (const FaceVectors& vectors : list)
            copy(vectors);
    }

    /// Swaps vectors with the next ones of the list instead of copying them; `list` is left with replaced vectors.
    void swap_in(std::vector<FaceVectors>& list)
    {
        for (FaceVectors& vectors : list)
            next().swap(vectors);
    }

    /// The number of estimates written so far.
    [[nodiscard]] int count() const { return static_cast<int>(count_); }

  private:
    std::vector<FaceVectors>* vectors_;
    std::size_t count_ = 0;
};

/// Adds a term of 1 - (1 - S)³ = 3 S - 3 S² + S³, if `round` is a round after which S, S² or S³ is complete.
/// @param rounds the number of rounds of S.
void add_low_pass(int round, int rounds, const FaceVectors& mean, FaceVectors& total, const Executor& exec)
{
    if (round % rounds != 0 || round > 3 * rounds)
        return;
    const int power = round / rounds;
    const float factor = power == 1 ? 3.0F : power == 2 ? -3.0F : 1.0F;
    total.resize(mean.rows(), 4);
    for_each(exec, static_cast<Index>(mean.rows()), [&](Index f) {
        if (power == 1)
            total.row(f) = factor * mean.row(f);
        else
            total.row(f) += factor * mean.row(f);
    });
}

/// Adds bilateral means: each round is guided by the result of the round before.
/// @param vectors of length 1 or 0; replaced by the last result. @param rounds_to_add the rounds whose results are
/// added, ascending. @param found receives these results.
void add_bilateral_means(const FaceAverages& averages, FaceVectors& vectors, float sigma,
                         std::initializer_list<int> rounds_to_add, Writer& found, FaceVectors& scratch,
                         const Executor& exec)
{
    const int last = *(rounds_to_add.end() - 1);
    for (int round = 1; round <= last; ++round) {
        averages.average(sigma, vectors, scratch, exec);
        vectors.swap(scratch);
        if (std::ranges::find(rounds_to_add, round) != rounds_to_add.end())
            found.copy(vectors);
        normalise(vectors, exec);
    }
}

}  // namespace

template <class OnRound>
void NormalEstimator::take_means(const FaceVectors& vectors, int rounds, const Executor& exec, OnRound&& on_round)
{
    for (int round = 1; round <= rounds; ++round) {
        averages_.average(weights_, round == 1 ? vectors : scratch_[(round + 1) % 2], scratch_[round % 2], exec);
        on_round(round, scratch_[round % 2]);
    }
}

NormalEstimator::NormalEstimator(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
    : averages_(mesh, topology, exec)
    , of_vertices_(mesh, topology, exec)
    , filters_(topology, of_vertices_.neighbours())
    , vertex_normals_(mesh, topology)
{
}

void NormalEstimator::begin(const Points& positions, const Executor& exec)
{
    averages_.measure(positions, exec);
    averages_.measure_normals(positions, noisy_, exec);
    of_positions_.clear();
    of_positions_further_.clear();
    of_robust_positions_.clear();
    const std::vector<Points> filtered = filters_.low_pass(positions, rounds_of_positions, exec);
    for (std::size_t i = 0; i < filtered.size(); ++i) {
        FaceVectors normals;
        averages_.measure_normals(filtered[i], normals, exec);
        if (rounds_of_positions[i] == 3 || rounds_of_positions[i] == 8 || rounds_of_positions[i] == 16)
            of_positions_further_.push_back(normals);
        if (rounds_of_positions[i] != 3)
            of_positions_.push_back(std::move(normals));
    }
    const Points& surface = filtered[index_of_surface];
    Points normals(positions.rows(), 3);
    for_each(exec, static_cast<Index>(positions.rows()),
             [&](Index v) { normals.row(v) = vertex_normals_(v, surface); });
    for (const Points& robust : filters_.robust_low_pass(positions, surface, normals, rounds_of_robust_positions, exec))
        averages_.measure_normals(robust, of_robust_positions_.emplace_back(), exec);
}

void NormalEstimator::first(NormalEstimates& found, const Executor& exec)
{
    Writer writer(found);
    writer.copy(noisy_);
    averages_.weigh(weights_, exec);
    FaceVectors once;
    FaceVectors twice;
    FaceVectors low_pass;
    take_means(noisy_, 8, exec, [&](int round, const FaceVectors& mean) {
        if (round == 1 || round == 2 || round == 4 || round == 8)
            writer.copy(mean);
        if (round == 1)
            once = mean;
        if (round == 2)
            twice = mean;
        add_low_pass(round, 2, mean, low_pass, exec);
    });
    writer.copy(low_pass);
    FaceVectors& bilateral = low_pass;
    bilateral = noisy_;
    add_bilateral_means(averages_, bilateral, 0.5F, {2, 5, 10}, writer, scratch_[0], exec);
    const int bilateral_anchor = writer.count() - 1;
    normalise(once, exec);
    add_bilateral_means(averages_, once, 0.3F, {3, 10}, writer, scratch_[0], exec);
    writer.swap_in(of_positions_);
    // The noisy normals, those of the positions after eight rounds, and the bilateral means after ten rounds.
    found.anchors = {0, writer.count() - 2, bilateral_anchor};
    averages_.average_best_patch(noisy_, writer.next(), exec);
    normalise(twice, exec);
    averages_.average_best_patch(twice, writer.next(), exec);
    writer.copy(of_robust_positions_);
}

void NormalEstimator::further(const FaceVectors& normals, NormalEstimates& found, const Executor& exec)
{
    Writer writer(found);
    writer.copy(normals);
    writer.copy(noisy_);
    for (const float sigma : {0.1F, 0.2F, 0.4F}) {
        averages_.weigh(normals, sigma, weights_, exec);
        FaceVectors low_pass;
        take_means(noisy_, 9, exec, [&](int round, const FaceVectors& mean) {
            if (round == 2 || round == 8)
                writer.copy(mean);
            add_low_pass(round, 3, mean, low_pass, exec);
        });
        writer.copy(low_pass);
        if (sigma == 0.1F)
            averages_.average_far(weights_, noisy_, writer.next(), scratch_, exec);
    }
    averages_.weigh(normals, 0.03F, weights_, exec);
    averages_.average_far(weights_, noisy_, writer.next(), scratch_, exec);
    const auto copy_first_and_last = [&](int rounds) {
        take_means(normals, rounds, exec, [&](int round, const FaceVectors& mean) {
            if (round == 1 || round == rounds)
                writer.copy(mean);
        });
    };
    averages_.weigh(normals, 0.15F, weights_, exec);
    copy_first_and_last(4);
    averages_.weigh(weights_, exec);
    copy_first_and_last(3);
    averages_.average_best_patch(normals, writer.next(), exec);
    FaceVectors bilateral = normals;
    add_bilateral_means(averages_, bilateral, 0.3F, {4}, writer, scratch_[0], exec);
    // The earlier result, the noisy normals, and the bilateral means of the earlier result.
    found.anchors = {0, 1, writer.count() - 1};
    writer.copy(of_positions_further_);
    writer.copy(of_robust_positions_);
}

}  // namespace seamflow
