#include "solvers/krylov/krylov_basis.h"

#include <cmath>
#include <limits>

#include "solvers/krylov/sums.h"

namespace seamflow {

namespace {

/// What rounding may leave of a direction that lies in the span of others.
constexpr double rounding_of_directions = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

using Eigen::Matrix3d;
using Eigen::RowVector3d;

Matrix3d KrylovBasis::begin(const Points& residual, const Loop& loop)
{
    n_used_ = 0;
    product_ = residual;
    return normalise(column_norms(product_, loop), loop);
}

void KrylovBasis::append()
{
    if (blocks_.size() == n_used_)
        blocks_.emplace_back();
    blocks_[n_used_++].swap(product_);
    product_.resize(n_, 3);
}

std::vector<Matrix3d> KrylovBasis::orthogonalise(const Loop& loop)
{
    const RowVector3d sizes = column_norms(product_, loop);
    std::vector<Matrix3d> amounts = project(loop);
    subtract(amounts, loop);
    const std::vector<Matrix3d> again = project(loop);
    subtract(again, loop);
    for (std::size_t k = 0; k < amounts.size(); ++k)
        amounts[k] += again[k];
    amounts.push_back(normalise(sizes, loop));
    return amounts;
}

/// Makes the columns of W orthonormal, or zero if they depend on others.
/// @param sizes what the columns' norms were before anything was taken away from them.
/// @returns the triangle by which they have to be multiplied to become what they were.
Matrix3d KrylovBasis::normalise(const RowVector3d& sizes, const Loop& loop)
{
    Matrix3d amounts = Matrix3d::Zero();
    for (Eigen::Index c = 0; c < 3; ++c) {
        for (int pass = 0; pass < 2 && c > 0; ++pass) {
            RowVector3d before = products_with_column(c, loop);
            before.tail(3 - c).setZero();
            for_each(loop, n_, [&](Index i) { product_(i, c) -= before.dot(product_.row(i)); });
            amounts.col(c) += before.transpose();
        }
        const double length = std::sqrt(products_with_column(c, loop)[c]);
        const bool is_new = length > rounding_of_directions * sizes[c];
        amounts(c, c) = is_new ? length : 0.0;
        for_each(loop, n_, [&](Index i) { product_(i, c) = is_new ? product_(i, c) / length : 0.0; });
    }
    return amounts;
}

RowVector3d KrylovBasis::products_with_column(Eigen::Index c, const Loop& loop) const
{
    return sum_of<RowVector3d>(loop, n_, [&](Index i) { return product_(i, c) * product_.row(i); });
}

/// Vᵀ W for all V.
std::vector<Matrix3d> KrylovBasis::project(const Loop& loop) const
{
    const Index n_blocks = n_ / block_size + 1;
    std::vector<Matrix3d> of_block(at(n_blocks) * n_used_, Matrix3d::Zero());
    for_each_block(loop, n_, [&](Index block, Index begin, Index end) {
        for (std::size_t k = 0; k < n_used_; ++k) {
            Matrix3d total = Matrix3d::Zero();
            for (Index i = begin; i < end; ++i)
                total += blocks_[k].row(i).transpose() * product_.row(i);
            of_block[at(block) * n_used_ + k] = total;
        }
    });
    std::vector<Matrix3d> sums(n_used_, Matrix3d::Zero());
    for (std::size_t b = 0; b < of_block.size(); ++b)
        sums[b % n_used_] += of_block[b];
    return sums;
}

void KrylovBasis::subtract(const std::vector<Matrix3d>& amounts, const Loop& loop)
{
    for_each_block(loop, n_, [&](Index, Index begin, Index end) {
        for (std::size_t k = 0; k < amounts.size(); ++k)
            for (Index i = begin; i < end; ++i)
                product_.row(i) -= blocks_[k].row(i) * amounts[k];
    });
}

void KrylovBasis::add_combination(const Eigen::MatrixXd& y, Points& x, const Loop& loop) const
{
    for_each_block(loop, n_, [&](Index, Index begin, Index end) {
        for (std::size_t k = 0; k < n_used_; ++k) {
            const Matrix3d amounts = y.middleRows<3>(static_cast<Eigen::Index>(3 * k));
            for (Index i = begin; i < end; ++i)
                x.row(i) += blocks_[k].row(i) * amounts;
        }
    });
}

}  // namespace seamflow
