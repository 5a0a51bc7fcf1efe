#include "solvers/systems/block_row_matrix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "partition/errors.h"
#include "partition/large_arrays.h"

namespace seamflow {

namespace {

/// A block's positive off-diagonal entries are neglected if the sum of their sizes is at most this fraction of the sum
/// of all sizes.
constexpr double most_positive = 0.05;
/// The fraction of the dropped fill that is subtracted from the diagonal.
constexpr float part_of_fill = 0.8F;
/// The least pivot, relative to the diagonal entry of A.
constexpr float least_pivot = 0.1F;

/// The quotients, per column; 0 where the denominator is not positive.
Eigen::Array4f quotients(const Eigen::Array4d& numerators, const Eigen::Array4d& denominators)
{
    return (denominators > 0.0).select(numerators / denominators, 0.0).cast<float>();
}

}  // namespace

BlockRowMatrix::BlockRowMatrix(std::vector<Index> blocks, const Pattern& pattern, const Executor& exec)
    : blocks_(std::move(blocks))
{
    // The columns of all rows, one element per block.
    std::vector<IndexLists> lists(blocks_.size() - 1);
    for (std::vector<Index>* begin : {&lower_.begin, &upper_.begin, &outer_.begin})
        *begin = large_vector<Index>(usize(n_rows()) + 1);
    for_each_block(exec, [&](Index block, Index begin, Index end) {
        lists[block] = pattern(block);
        for (Index i = begin; i < end; ++i) {
            const std::span<const Index> columns = lists[block][i - begin];
            const Index first = place_in(columns, begin);
            const Index diagonal = place_in(columns, i);
            const Index last = place_in(columns, end);
            lower_.begin[i + 1] = diagonal - first;
            upper_.begin[i + 1] = last - diagonal;
            outer_.begin[i + 1] = static_cast<Index>(columns.size()) - last + first;
        }
    });
    const auto reserve = []<class Value>(Buffer<Value>& buffer, Index n) { buffer = uninitialised<Value>(usize(n)); };
    const auto reserve_entries = [&](auto& entries) {
        if (std::accumulate(entries.begin.begin(), entries.begin.end(), std::int64_t{0}) >
            std::numeric_limits<Index>::max())
            throw ComputationError("the equations of the whole mesh have more than 2147483647 coefficients: use "
                                   "sub-meshes instead of conjugate gradients");
        std::partial_sum(entries.begin.begin(), entries.begin.end(), entries.begin.begin());
        reserve(entries.columns, entries.begin.back());
        reserve(entries.values, entries.begin.back());
    };
    reserve_entries(lower_);
    reserve_entries(upper_);
    reserve_entries(outer_);
    for_each_block(exec, [&](Index block, Index begin, Index end) {
        const IndexLists rows = std::move(lists[block]);
        for (Index i = begin; i < end; ++i) {
            const std::span<const Index> columns = rows[i - begin];
            const auto first = std::ranges::find_if(columns, [&](Index column) { return column >= begin; });
            const auto diagonal = first + (lower_.begin[i + 1] - lower_.begin[i]);
            const auto last = diagonal + (upper_.begin[i + 1] - upper_.begin[i]);
            const auto inner = [&](Index column) { return static_cast<Inner>(column - begin); };
            std::transform(first, diagonal, lower_.columns.get() + lower_.begin[i], inner);
            std::transform(diagonal, last, upper_.columns.get() + upper_.begin[i], inner);
            const auto end_of_left = std::copy(columns.begin(), first, outer_.columns.get() + outer_.begin[i]);
            std::copy(last, columns.end(), end_of_left);
        }
    });
    // The values reuse the memory that the lists have freed.
    for (Buffer<float>* values : {&diagonal_, &pivot_})
        reserve(*values, n_rows());
    for (Buffer<StoredRow>* rows : {&residual_, &direction_, &increment_})
        reserve(*rows, n_rows());
    for (Buffer<Row>* rows : {&step_, &product_})
        reserve(*rows, n_rows());
    for_each_block(exec, [&](Index, Index begin, Index end) {
        // The row of the identity. It stays for vertices without columns.
        std::fill(&diagonal_[begin], &diagonal_[end], 1.0F);
        std::fill(&residual_[begin], &residual_[end], Row(Row::Zero()));
    });
}

BlockRowMatrix::Entry BlockRowMatrix::entry(const BlockRow& in_block, Index column)
{
    const Index inner = column - in_block.begin;
    // A column of a later block may also be less than most_rows away; it is not found in this block.
    if (inner >= 0 && inner < most_rows) {
        Entries<Inner>& part = column < in_block.row ? lower_ : upper_;
        if (const Index e = part.find(in_block.row, static_cast<Inner>(inner)); e >= 0)
            return part.entry(e);
    }
    return outer_.entry(outer_.find(in_block.row, column));
}

void BlockRowMatrix::keep_exact()
{
    if (std::exchange(keeps_exact_, true))
        return;
    const auto make_room = [](auto& entries) { entries.exact = uninitialised<double>(usize(entries.begin.back())); };
    make_room(lower_);
    make_room(upper_);
    make_room(outer_);
}

/// In a block whose positive off-diagonal entries are negligible (see most_positive): a modified incomplete
/// factorisation (Gustafsson, A class of first order factorization methods, 1978). The fill is dropped, and part of it
/// is subtracted from the diagonal; all of it would preserve the sums of rows. Pivots are so large that back
/// substitution does not amplify. In other blocks the pivots are the diagonal itself: symmetric Gauss–Seidel.
void BlockRowMatrix::factorise(const Executor& exec)
{
    for_each_block(exec, [&](Index, Index begin, Index end) {
        double positive = 0.0;
        double all = 0.0;
        for (Index e = lower_.begin[begin]; e < lower_.begin[end]; ++e) {
            positive += std::max(lower_.values[e], 0.0F);
            all += std::abs(lower_.values[e]);
        }
        if (positive > most_positive * all) {
            std::copy(&diagonal_[begin], &diagonal_[end], &pivot_[begin]);
            return;
        }
        // For each row before the present one, the sum of the entries above the diagonal.
        std::vector<float> above(end - begin);
        for (Index i = begin; i < end; ++i) {
            float pivot = diagonal_[i];
            for (Index e = lower_.begin[i]; e < lower_.begin[i + 1]; ++e) {
                const Index k = lower_.columns[e];
                const float value = lower_.values[e];
                pivot -= value / pivot_[begin + k] * (value + part_of_fill * (above[k] - value));
            }
            float size = 0.0F;
            for (Index e = upper_.begin[i]; e < upper_.begin[i + 1]; ++e) {
                above[i - begin] += upper_.values[e];
                size += std::abs(upper_.values[e]);
            }
            pivot_[i] = std::max({pivot, size, least_pivot * diagonal_[i]});
        }
    });
}

Eigen::Array4d BlockRowMatrix::start(float scale, const Executor& exec)
{
    return sum_of_blocks<Eigen::Array4d>(exec, [&](Index begin, Index end) {
        const Entries<Inner>::Product lower(lower_);
        Eigen::Array4d sum = Eigen::Array4d::Zero();
        for (Index i = begin; i < end; ++i) {
            Row r = scale * Row(residual_[i]);
            lower.subtract_from(r, i, &product_[begin]);
            product_[i] = 1.0F / pivot_[i] * r;
            residual_[i] = product_[i];
            sum += (product_[i] * r).cast<double>();
            direction_[i] = increment_[i] = Row(Row::Zero());
            step_[i].setZero();
        }
        return sum;
    });
}

/// increment += α t; p = D r + β p; t = (D + Lᵀ)⁻¹ p.
void BlockRowMatrix::solve_upper(const Row& alpha, const Row& beta, const Executor& exec)
{
    for_each_block(exec, [&, alpha = alpha, beta = beta](Index, Index begin, Index end) {
        const Entries<Inner>::Product upper(upper_);
        const float* const pivot = pivot_.get();
        const StoredRow* const residual = residual_.get();
        StoredRow* const direction = direction_.get();
        Row* const step = step_.get();
        StoredRow* const increment = increment_.get();
        for (Index i = end - 1; i >= begin; --i) {
            increment[i] = Row(Row(increment[i]) + alpha * step[i]);
            Row p = pivot[i] * Row(residual[i]) + beta * Row(direction[i]);
            direction[i] = p;
            upper.subtract_from(p, i, step + begin);
            step[i] = 1.0F / pivot[i] * p;
        }
    });
}

/// q = (D + L)⁻¹ A t = t + (D + L)⁻¹ (p + (A - L - 2 D - Lᵀ) t), because (D + Lᵀ) t = p.
/// @returns Σ p q.
Eigen::Array4d BlockRowMatrix::solve_lower(const Executor& exec)
{
    return sum_of_blocks<Eigen::Array4d>(exec, [&](Index begin, Index end) {
        const Entries<Inner>::Product lower(lower_);
        const Entries<Index>::Product outer(outer_);
        const float* const diagonal = diagonal_.get();
        const float* const pivot = pivot_.get();
        const StoredRow* const direction = direction_.get();
        const Row* const step = step_.get();
        Row* const product = product_.get();
        Eigen::Array4d sum = Eigen::Array4d::Zero();
        for (Index i = begin; i < end; ++i) {
            const Row t = step[i];
            const Row p = direction[i];
            Row q = -(diagonal[i] - 2.0F * pivot[i]) * t;
            outer.subtract_from(q, i, step);
            q = p - q;
            lower.subtract_from(q, i, product + begin);
            q *= 1.0F / pivot[i];
            product[i] = q;
            sum += (p * (q + t)).cast<double>();
        }
        return sum;
    });
}

/// r -= α q.
/// @returns Σ r D r.
Eigen::Array4d BlockRowMatrix::update_residual(const Row& alpha, const Executor& exec)
{
    return sum_of_blocks<Eigen::Array4d>(exec, [&, alpha = alpha](Index begin, Index end) {
        const float* const pivot = pivot_.get();
        const Row* const product = product_.get();
        const Row* const step = step_.get();
        StoredRow* const residual = residual_.get();
        Eigen::Array4d sum = Eigen::Array4d::Zero();
        for (Index i = begin; i < end; ++i) {
            const Row r = Row(residual[i]) - alpha * (product[i] + step[i]);
            residual[i] = r;
            sum += (pivot[i] * r * r).cast<double>();
        }
        return sum;
    });
}

BlockRowMatrix::Result BlockRowMatrix::iterate(const Eigen::Array4d& squared_at_start, double goal, int most_iterations,
                                               const Executor& exec)
{
    Eigen::Array4d squared = squared_at_start;
    const double first = squared.sum();
    Row alpha = Row::Zero();
    Row beta = Row::Zero();
    Result result;
    result.residual = 1.0;
    while (result.iterations < most_iterations && result.residual > goal) {
        solve_upper(alpha, beta, exec);
        alpha = quotients(squared, solve_lower(exec));
        const Eigen::Array4d squared_before = squared;
        squared = update_residual(alpha, exec);
        beta = quotients(squared, squared_before);
        ++result.iterations;
        result.residual = std::sqrt(squared.sum() / first);
    }
    std::vector<float> farthest(blocks_.size(), 0.0F);
    for_each_block(exec, [&](Index block, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Row change = alpha * step_[i];
            increment_[i] = Row(Row(increment_[i]) + change);
            farthest[block] = std::max(farthest[block], change.square().sum());
        }
    });
    result.last_update = std::sqrt(*std::max_element(farthest.begin(), farthest.end()));
    return result;
}

}  // namespace seamflow
