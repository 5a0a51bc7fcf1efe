#include "solvers/gmres.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seamflow {

namespace {

/// What rounding may leave of a direction that lies in the span of those before.
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

Index n_blocks_of(Index n)
{
    return n / block_size + (n % block_size > 0 ? 1 : 0);
}

}  // namespace

double norm(const Points& a, const Loop& loop)
{
    return std::sqrt(sum(loop, static_cast<Index>(a.rows()), [&](Index i) { return a.row(i).squaredNorm(); }));
}

int Gmres::improve(const Multiply& multiply, const Points& residual, double goal, int most, Points& x, const Loop& loop)
{
    begin(residual, most, loop);
    int j = 0;
    while (j < most && right_hand_side_.back().matrix().norm() > goal) {
        multiply(directions_[static_cast<std::size_t>(j)], product_);
        orthogonalise(j, loop);
        rotate(j);
        ++j;
    }
    add_combination(j, x, loop);
    return j;
}

void Gmres::begin(const Points& residual, int most, const Loop& loop)
{
    triangle_.clear();
    rotations_.clear();
    right_hand_side_.assign(1, norms(residual, loop));
    const Triple size = right_hand_side_.front();
    const Triple scale = (size > 0.0).select(size.inverse(), 0.0);
    if (directions_.empty() && most > 0)
        directions_.emplace_back();
    product_.resize(n_, 3);
    if (directions_.empty())
        return;
    directions_.front().resize(n_, 3);
    for_each(loop, n_,
             [&](Index i) { directions_.front().row(i) = (residual.row(i).array() * scale).matrix(); });
}

/// Makes the next direction of the product, and the next column of the Hessenberg matrices.
void Gmres::orthogonalise(int j, const Loop& loop)
{
    const Triple before = norms(product_, loop);
    std::vector<Triple> column = project(j + 1, loop);
    take_away(j + 1, column, loop);
    const std::vector<Triple> again = project(j + 1, loop);
    take_away(j + 1, again, loop);
    for (std::size_t i = 0; i < column.size(); ++i)
        column[i] += again[i];
    const Triple after = norms(product_, loop);
    const Triple size = (after > rounding * before).select(after, 0.0);
    const Triple scale = (size > 0.0).select(size.inverse(), 0.0);
    column.push_back(size);
    triangle_.push_back(std::move(column));
    const auto next = static_cast<std::size_t>(j) + 1;
    if (directions_.size() <= next)
        directions_.emplace_back();
    directions_[next].resize(n_, 3);
    for_each(loop, n_, [&](Index i) { directions_[next].row(i) = (product_.row(i).array() * scale).matrix(); });
}

/// The products of the first directions with `product_`.
std::vector<Gmres::Triple> Gmres::project(int n_directions, const Loop& loop) const
{
    const auto n = static_cast<std::size_t>(n_directions);
    std::vector<Triple> of_block(at(n_blocks_of(n_)) * n, Triple::Zero());
    for_each_block(loop, n_, [&](Index block, Index begin, Index end) {
        for (std::size_t k = 0; k < n; ++k) {
            Triple total = Triple::Zero();
            for (Index i = begin; i < end; ++i)
                total += directions_[k].row(i).array() * product_.row(i).array();
            of_block[at(block) * n + k] = total;
        }
    });
    std::vector<Triple> sums(n, Triple::Zero());
    for (std::size_t b = 0; b < of_block.size(); ++b)
        sums[b % n] += of_block[b];
    return sums;
}

void Gmres::take_away(int n_directions, const std::vector<Triple>& amounts, const Loop& loop)
{
    for_each_block(loop, n_, [&](Index, Index begin, Index end) {
        for (std::size_t k = 0; k < static_cast<std::size_t>(n_directions); ++k)
            for (Index i = begin; i < end; ++i)
                product_.row(i).array() -= amounts[k] * directions_[k].row(i).array();
    });
}

Gmres::Triple Gmres::norms(const Points& a, const Loop& loop) const
{
    std::vector<Triple> of_block(at(n_blocks_of(n_)), Triple::Zero());
    for_each_block(loop, n_, [&](Index block, Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
            of_block[at(block)] += a.row(i).array().square();
    });
    Triple total = Triple::Zero();
    for (const Triple& part : of_block)
        total += part;
    return total.sqrt();
}

/// Givens rotations.
void Gmres::rotate(int j)
{
    std::vector<Triple>& column = triangle_.back();
    const auto last = static_cast<std::size_t>(j);
    for (std::size_t i = 0; i < last; ++i) {
        const auto& [cosine, sine] = rotations_[i];
        const Triple upper = cosine * column[i] + sine * column[i + 1];
        column[i + 1] = cosine * column[i + 1] - sine * column[i];
        column[i] = upper;
    }
    const Triple length = (column[last].square() + column[last + 1].square()).sqrt();
    const Triple scale = (length > 0.0).select(length.inverse(), 0.0);
    Rotation rotation{(length > 0.0).select(column[last] * scale, 1.0), column[last + 1] * scale};
    column[last] = length;
    column.pop_back();
    right_hand_side_.emplace_back(-rotation.sine * right_hand_side_[last]);
    right_hand_side_[last] *= rotation.cosine;
    rotations_.push_back(rotation);
}

/// Back substitution, then the directions as often as it says.
void Gmres::add_combination(int n_directions, Points& x, const Loop& loop) const
{
    const auto n = static_cast<std::size_t>(n_directions);
    std::vector<Triple> amounts(right_hand_side_.begin(), right_hand_side_.begin() + n_directions);
    for (std::size_t j = n; j-- > 0;) {
        const Triple pivot = triangle_[j][j];
        amounts[j] = (pivot > 0.0).select(amounts[j] / pivot, 0.0);
        for (std::size_t i = 0; i < j; ++i)
            amounts[i] -= triangle_[j][i] * amounts[j];
    }
    for_each_block(loop, n_, [&](Index, Index begin, Index end) {
        for (std::size_t k = 0; k < n; ++k)
            for (Index i = begin; i < end; ++i)
                x.row(i).array() += amounts[k] * directions_[k].row(i).array();
    });
}

}  // namespace seamflow
