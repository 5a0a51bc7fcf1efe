#include "solvers/krylov/hessenberg.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace seamflow {

using Eigen::Matrix3d;
using Eigen::RowVector3d;

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

/// Takes in a column of the Hessenberg matrix: rotated like the ones before, then so that nothing is left below its
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

/// The amplification takes more the more directions there are: of many, a few more are waited for before it is found
/// anew.
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
