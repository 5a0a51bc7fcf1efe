#include "solvers/krylov/arnoldi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "solvers/krylov/sums.h"

namespace seamflow {

namespace {

/// The remainder that rounding may leave of a direction in the span of others.
constexpr double rounding_of_directions = 16.0 * std::numeric_limits<double>::epsilon();

}  // namespace

using Eigen::Matrix3d;
using Eigen::RowVector3d;

Matrix3d KrylovBasis::begin(const Points& residual, const Executor& exec)
{
    n_used_ = 0;
    product_ = residual;
    return normalise(column_norms(product_, exec), exec);
}

void KrylovBasis::append()
{
    if (blocks_.size() == n_used_)
        blocks_.emplace_back();
    blocks_[n_used_++].swap(product_);
    product_.resize(n_, 3);
}

std::vector<Matrix3d> KrylovBasis::orthogonalise(const Executor& exec)
{
    const RowVector3d sizes = column_norms(product_, exec);
    std::vector<Matrix3d> amounts = project(exec);
    subtract(amounts, exec);
    const std::vector<Matrix3d> again = project(exec);
    subtract(again, exec);
    for (std::size_t k = 0; k < amounts.size(); ++k)
        amounts[k] += again[k];
    amounts.push_back(normalise(sizes, exec));
    return amounts;
}

/// Makes the columns of W orthonormal, or zero if they depend on others.
/// @param sizes the columns' norms before anything was subtracted from them.
/// @returns the triangle by which they must be multiplied to give the original columns.
Matrix3d KrylovBasis::normalise(const RowVector3d& sizes, const Executor& exec)
{
    Matrix3d amounts = Matrix3d::Zero();
    for (Eigen::Index c = 0; c < 3; ++c) {
        for (int pass = 0; pass < 2 && c > 0; ++pass) {
            RowVector3d before = products_with_column(c, exec);
            before.tail(3 - c).setZero();
            for_each(exec, n_, [&](Index i) { product_(i, c) -= before.dot(product_.row(i)); });
            amounts.col(c) += before.transpose();
        }
        const double length = std::sqrt(products_with_column(c, exec)[c]);
        const bool is_new = length > rounding_of_directions * sizes[c];
        amounts(c, c) = is_new ? length : 0.0;
        for_each(exec, n_, [&](Index i) { product_(i, c) = is_new ? product_(i, c) / length : 0.0; });
    }
    return amounts;
}

RowVector3d KrylovBasis::products_with_column(Eigen::Index c, const Executor& exec) const
{
    return sum_of<RowVector3d>(exec, n_, [&](Index i) { return product_(i, c) * product_.row(i); });
}

/// Vᵀ W for all V.
std::vector<Matrix3d> KrylovBasis::project(const Executor& exec) const
{
    std::vector<Matrix3d> sums;
    for (std::size_t k = 0; k < n_used_; ++k)
        sums.push_back(sum_of<Matrix3d>(
            exec, n_, [&](Index i) -> Matrix3d { return blocks_[k].row(i).transpose() * product_.row(i); }));
    return sums;
}

void KrylovBasis::subtract(const std::vector<Matrix3d>& amounts, const Executor& exec)
{
    for_each_block(exec, n_, [&](Index, Index begin, Index end) {
        for (std::size_t k = 0; k < amounts.size(); ++k)
            for (Index i = begin; i < end; ++i)
                product_.row(i) -= blocks_[k].row(i) * amounts[k];
    });
}

void KrylovBasis::add_combination(const Eigen::MatrixXd& y, Points& x, const Executor& exec) const
{
    for_each_block(exec, n_, [&](Index, Index begin, Index end) {
        for (std::size_t k = 0; k < n_used_; ++k) {
            const Matrix3d amounts = y.middleRows<3>(static_cast<Eigen::Index>(3 * k));
            for (Index i = begin; i < end; ++i)
                x.row(i) += blocks_[k].row(i) * amounts;
        }
    });
}

HessenbergLeastSquares::HessenbergLeastSquares(const Matrix3d& first)
{
    for (Eigen::Index r = 0; r < 3; ++r)
        right_hand_side_.emplace_back(first.row(r));
}

void HessenbergLeastSquares::append(const std::vector<Matrix3d>& blocks)
{
    for (int r = 0; r < 3; ++r)
        right_hand_side_.emplace_back(RowVector3d::Zero());
    for (Eigen::Index c = 0; c < 3; ++c) {
        std::vector<double> column;
        for (const Matrix3d& block : blocks)
            for (Eigen::Index r = 0; r < 3; ++r)
                column.push_back(block(r, c));
        rotate(std::move(column));
    }
}

/// Adds a column of the Hessenberg matrix: rotated like the ones before, then so that nothing is left below its
/// diagonal.
void HessenbergLeastSquares::rotate(std::vector<double> column)
{
    const auto turn = [](const Rotation& rotation, auto& first, auto& second) {
        using Value = std::remove_cvref_t<decltype(first)>;
        const Value turned = rotation.cosine * first + rotation.sine * second;
        second = rotation.cosine * second - rotation.sine * first;
        first = turned;
    };
    for (const Rotation& rotation : rotations_)
        turn(rotation, column[rotation.first], column[rotation.second]);
    const std::size_t diagonal = triangle_.size();
    for (std::size_t below = diagonal + 1; below < column.size(); ++below) {
        if (column[below] == 0.0)
            continue;
        const double length = std::hypot(column[diagonal], column[below]);
        const Rotation rotation{diagonal, below, column[diagonal] / length, column[below] / length};
        turn(rotation, column[diagonal], column[below]);
        turn(rotation, right_hand_side_[diagonal], right_hand_side_[below]);
        rotations_.push_back(rotation);
    }
    column.resize(diagonal + 1);
    triangle_.push_back(std::move(column));
}

double HessenbergLeastSquares::residual() const
{
    double squares = 0.0;
    for (std::size_t r = triangle_.size(); r < right_hand_side_.size(); ++r)
        squares += right_hand_side_[r].squaredNorm();
    return std::sqrt(squares);
}

/// The amplification costs more the more directions there are: with many, it is only computed again after a few more.
bool HessenbergLeastSquares::has_reached(double goal)
{
    const double size = residual();
    if (size > goal || triangle_.size() < next_size_to_check_)
        return false;
    next_size_to_check_ = triangle_.size() + triangle_.size() / 64;
    return size * std::max(1.0, amplification() / most_amplification) <= goal;
}

/// By power iteration on (RᵀR)⁻¹, R the triangle.
double HessenbergLeastSquares::amplification() const
{
    constexpr int iterations = 6;
    double inverse_square = 0.0;
    Eigen::VectorXd z = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(triangle_.size()));
    for (int iteration = 0; iteration < iterations && z.size() > 0 && z.norm() > 0.0; ++iteration) {
        z /= z.norm();
        divide_by_transpose(z);
        divide(z);
        inverse_square = z.norm();
    }
    return std::max(1.0, std::sqrt(inverse_square));
}

/// z becomes R⁻ᵀ z. Directions that were left out have empty columns and rows.
void HessenbergLeastSquares::divide_by_transpose(Eigen::VectorXd& z) const
{
    for (std::size_t j = 0; j < triangle_.size(); ++j) {
        const std::vector<double>& column = triangle_[j];
        double& entry = z[static_cast<Eigen::Index>(j)];
        for (std::size_t i = 0; i < j; ++i)
            entry -= column[i] * z[static_cast<Eigen::Index>(i)];
        entry = column[j] == 0.0 ? 0.0 : entry / column[j];
    }
}

/// z becomes R⁻¹ z.
void HessenbergLeastSquares::divide(Eigen::VectorXd& z) const
{
    for (std::size_t j = triangle_.size(); j-- > 0;) {
        const std::vector<double>& column = triangle_[j];
        double& entry = z[static_cast<Eigen::Index>(j)];
        entry = column[j] == 0.0 ? 0.0 : entry / column[j];
        for (std::size_t i = 0; i < j; ++i)
            z[static_cast<Eigen::Index>(i)] -= column[i] * entry;
    }
}

Eigen::MatrixXd HessenbergLeastSquares::solution() const
{
    const auto n = static_cast<Eigen::Index>(triangle_.size());
    Eigen::MatrixXd y(n, 3);
    for (Eigen::Index c = 0; c < 3; ++c) {
        Eigen::VectorXd column(n);
        for (Eigen::Index r = 0; r < n; ++r)
            column[r] = right_hand_side_[static_cast<std::size_t>(r)][c];
        divide(column);
        y.col(c) = column;
    }
    return y;
}

}  // namespace seamflow
