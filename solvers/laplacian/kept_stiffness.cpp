#include "solvers/laplacian/kept_stiffness.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace seamflow {

namespace {

/// The least kept mass, as a fraction of K's diagonal times dt. A smaller mass would be lost to rounding, and with it
/// the position of a component that is so small. More mass only delays the shrinking of the component to a point, its
/// centroid.
constexpr double least_kept_mass = 1e-10;

/// Stiffness of given positions, kept in all steps; mass kept, too, or recomputed in each step.
class KeptStiffness final : public SymmetricLaplacian {
  public:
    KeptStiffness(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices, const Points& positions,
                  bool keeps_mass)
        : laplacian_(std::move(laplacian))
        , pairs_(laplacian_->pairs())
        , n_vertices_(n_vertices)
        , diagonal_(n_vertices + laplacian_->n_auxiliary())
        , keeps_mass_(keeps_mass)
    {
        KeptStiffness::set_reference(positions);
    }

    void set_reference(const Points& positions) override
    {
        if (is_given_)
            // The given K and M depend on no positions: only the weighing is undone.
            return take_given(unweighted_.empty() ? std::move(entries_) : std::move(unweighted_));
        std::vector<Index> slots(pairs_.size());
        std::iota(slots.begin(), slots.end(), 0);
        std::vector<double> mass(diagonal_.size());
        entries_.assign(pairs_.size(), 0.0);
        laplacian_->assemble(positions, 1.0, slots, entries_, diagonal_, mass);
        if (keeps_mass_)
            mass_ = std::move(mass);
        unweighted_.clear();
    }

    void give(const GivenStiffness& given, std::span<const Index> local_to_global) override
    {
        // Each vertex has one pair per face and other corner of this face: its mass is shared evenly by these pairs.
        const auto share_of_mass = [&](Index local) {
            const Index v = local_to_global[usize(local)];
            Index n = 0;
            for (Index i = given.neighbours.offsets[v]; i < given.neighbours.offsets[v + 1]; ++i)
                n += given.n_faces[i];
            return given.mass[v] / n;
        };
        is_given_ = true;
        mass_.assign(diagonal_.size(), 0.0);
        std::vector<double> shares(mass_.size(), -1.0);
        std::vector<double> entries;
        for (const auto& [first, second] : pairs_) {
            const Index v = local_to_global[usize(first)];
            const Index i = given.neighbours.offsets[v] + place_in(given.neighbours[v], local_to_global[usize(second)]);
            entries.push_back(-given.weights[i] / given.n_faces[i]);
            for (const Index local : {first, second}) {
                if (shares[local] < 0.0)
                    shares[local] = share_of_mass(local);
                mass_[local] += shares[local];
            }
        }
        take_given(std::move(entries));
    }

    void for_each_element(const std::function<void(std::size_t)>& action) const override
    {
        laplacian_->for_each_element(action);
    }

    /// Divides K of each element, a face or an edge, by 1 + the largest squared difference of two of its vertices. K of
    /// a face with auxiliary unknowns is S - C D⁻¹ Cᵀ (see SymmetricLaplacian). The pairs of an element are first those
    /// of S, of two vertices, then those of C, of a vertex and an auxiliary unknown, one unknown after another.
    /// Diagonals follow from rows that sum to zero.
    void weigh(const SquaredDifference& squared_difference) override
    {
        if (unweighted_.empty()) {
            unweighted_ = entries_;
            unweighted_auxiliary_.assign(diagonal_.begin() + n_vertices_, diagonal_.end());
        }
        std::ranges::fill(diagonal_, 0.0);
        std::size_t begin = 0;
        laplacian_->for_each_element([&](std::size_t n) {
            const double largest = largest_difference(begin, begin + n, squared_difference);
            std::size_t i = begin;
            for (; i < begin + n && !is_auxiliary(pairs_[i].second); ++i) {
                entries_[i] = unweighted_[i] / (1.0 + largest);
                diagonal_[pairs_[i].first] -= entries_[i];
                diagonal_[pairs_[i].second] -= entries_[i];
            }
            // S, C and D of a face are divided by the same number, and the rows of S - C D⁻¹ Cᵀ still sum to zero.
            for (std::size_t end = i; i < begin + n; i = end) {
                const Index auxiliary = pairs_[i].second;
                const double d = unweighted_auxiliary_[auxiliary - n_vertices_];
                // -Σ C / D of the unknown.
                double sum_of_column = 0.0;
                for (; end < begin + n && pairs_[end].second == auxiliary; ++end)
                    sum_of_column -= unweighted_[end] / d;
                diagonal_[auxiliary] = d / (1.0 + largest);
                for (std::size_t k = i; k < end; ++k) {
                    entries_[k] = unweighted_[k] / (1.0 + largest);
                    diagonal_[pairs_[k].first] -= sum_of_column * entries_[k];
                }
            }
            begin += n;
        });
    }

    [[nodiscard]] bool uses_faces() const override { return laplacian_->uses_faces(); }
    [[nodiscard]] std::vector<VertexPair> pairs() const override { return pairs_; }
    [[nodiscard]] Index n_auxiliary() const override { return laplacian_->n_auxiliary(); }

    void assemble(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values,
                  std::span<double> diagonal, std::span<double> mass, const StiffnessProduct* product) override
    {
        measure_mass(positions, mass);
        for (std::size_t v = 0; v < diagonal_.size(); ++v) {
            diagonal[v] = factor * diagonal_[v];
            if (!mass_.empty() && !is_auxiliary(static_cast<Index>(v)))
                mass[v] = std::max(mass[v], least_kept_mass * diagonal[v]);
        }
        with_product(product, [&](auto&& add_to_product) {
            for (std::size_t i = 0; i < pairs_.size(); ++i) {
                const double entry = factor * entries_[i];
                const auto [v, w] = pairs_[i];
                if (!is_auxiliary(w))
                    add_to_product(v, w, entry, positions.row(w) - positions.row(v));
                values[slots[i]] += entry;
            }
        });
        for (std::size_t begin = 0, end = 0; product != nullptr && n_auxiliary() > 0 && begin < pairs_.size();
             begin = end) {
            const Index auxiliary = pairs_[begin].second;
            for (end = begin; end < pairs_.size() && pairs_[end].second == auxiliary;)
                ++end;
            if (is_auxiliary(auxiliary))
                add_auxiliary(
                    *product, positions, end - begin, [&](std::size_t i) { return pairs_[begin + i].first; },
                    [&](std::size_t i) { return factor * entries_[begin + i]; }, diagonal[auxiliary]);
        }
    }

    void measure_mass(const Points& positions, std::span<double> mass) const override
    {
        if (mass_.empty())
            laplacian_->measure_mass(positions, mass);
        else
            std::ranges::copy(mass_, mass.begin());
    }

  private:
    [[nodiscard]] bool is_auxiliary(Index v) const { return v >= n_vertices_; }

    /// Replaces the kept K by given entries, one per pair, and its diagonal by minus their sums.
    void take_given(std::vector<double> entries)
    {
        entries_ = std::move(entries);
        unweighted_.clear();
        std::ranges::fill(diagonal_, 0.0);
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            diagonal_[pairs_[i].first] -= entries_[i];
            diagonal_[pairs_[i].second] -= entries_[i];
        }
    }

    /// The largest squared difference of any two vertices of the face or edge whose pairs are [begin, end).
    [[nodiscard]] double largest_difference(std::size_t begin, std::size_t end,
                                            const SquaredDifference& squared_difference) const
    {
        // A face with auxiliary unknowns lists only pairs of consecutive corners.
        const bool has_all_pairs = begin == end || !is_auxiliary(pairs_[end - 1].second);
        double largest = 0.0;
        for (std::size_t i = begin; i < end && !is_auxiliary(pairs_[i].second); ++i)
            for (std::size_t k = i; k < (has_all_pairs ? i + 1 : end) && !is_auxiliary(pairs_[k].second); ++k)
                largest = std::max(largest, squared_difference(pairs_[i].first, pairs_[k].second));
        return largest;
    }

    std::unique_ptr<SymmetricLaplacian> laplacian_;
    std::vector<VertexPair> pairs_;
    Index n_vertices_;
    /// Per pair: the kept entry of K; and, if entries are weighed, the entry before weighing, with the diagonal of the
    /// auxiliary unknowns.
    std::vector<double> entries_;
    std::vector<double> unweighted_;
    std::vector<double> unweighted_auxiliary_;
    /// Per vertex and auxiliary unknown: the diagonal of K, and M. M is empty if it follows the mesh.
    std::vector<double> diagonal_;
    std::vector<double> mass_;
    bool keeps_mass_;
    /// Whether K and M were given (see SymmetricLaplacian::give).
    bool is_given_ = false;
};

}  // namespace

std::unique_ptr<SymmetricLaplacian> keep_stiffness(std::unique_ptr<SymmetricLaplacian> laplacian, Index n_vertices,
                                                   const Points& positions, bool keeps_mass)
{
    return std::make_unique<KeptStiffness>(std::move(laplacian), n_vertices, positions, keeps_mass);
}

}  // namespace seamflow
