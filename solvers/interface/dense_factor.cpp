#include "solvers/interface/dense_factor.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "solvers/interface/power_of_two.h"
#include "solvers/wide.h"

namespace seamflow {

namespace {

/// x += factor_x · column, and so on, for three vectors at once.
SEAMFLOW_WIDE void add_column(const float* __restrict column, std::size_t n, float factor_x, float factor_y,
                              float factor_z, float* __restrict x, float* __restrict y, float* __restrict z)
{
    for (std::size_t i = 0; i < n; ++i) {
        x[i] += factor_x * column[i];
        y[i] += factor_y * column[i];
        z[i] += factor_z * column[i];
    }
}

/// As many sums as wide registers have. By name, because compilers do not find them in loops.
using Lanes [[gnu::vector_size(32)]] = float;
constexpr std::size_t n_lanes = sizeof(Lanes) / sizeof(float);

float sum_of(const Lanes& lanes)
{
    return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
}

/// result = column · x, and so on.
SEAMFLOW_WIDE void multiply_column(const float* __restrict column, std::size_t n, const float* __restrict x,
                                   const float* __restrict y, const float* __restrict z, float* __restrict result)
{
    Lanes sums_x{};
    Lanes sums_y{};
    Lanes sums_z{};
    const std::size_t n_whole = n / n_lanes * n_lanes;
    for (std::size_t i = 0; i < n_whole; i += n_lanes) {
        Lanes factors;
        Lanes values;
        std::memcpy(&factors, column + i, sizeof factors);
        std::memcpy(&values, x + i, sizeof values);
        sums_x += factors * values;
        std::memcpy(&values, y + i, sizeof values);
        sums_y += factors * values;
        std::memcpy(&values, z + i, sizeof values);
        sums_z += factors * values;
    }
    for (std::size_t i = n_whole; i < n; ++i) {
        sums_x[0] += column[i] * x[i];
        sums_y[0] += column[i] * y[i];
        sums_z[0] += column[i] * z[i];
    }
    result[0] = sum_of(sums_x);
    result[1] = sum_of(sums_y);
    result[2] = sum_of(sums_z);
}

void multiply_by_diagonal(const std::vector<float>& diagonal, FloatColumns v)
{
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        v.x[i] *= diagonal[i];
        v.y[i] *= diagonal[i];
        v.z[i] *= diagonal[i];
    }
}

}  // namespace

void DenseFactor::take(const DenseLdl& factor)
{
    n_ = static_cast<Index>(factor.rows());
    values_.resize(begin_of(n_));
    root_.resize(at(n_));
    inverse_.resize(at(n_));
    scale_ = n_ > 0 ? power_of_two_near(factor.diagonal().maxCoeff()) : 1.0;
    for (Index row = 0; row < n_; ++row) {
        for (Index column = 0; column < row; ++column)
            below(column)[row - column - 1] = static_cast<float>(factor(row, column));
        const double pivot = factor(row, row) / scale_;
        root_[at(row)] = static_cast<float>(std::sqrt(pivot));
        inverse_[at(row)] = static_cast<float>(1.0 / pivot);
    }
}

/// Adds the multiple sign · v_column of a column of L, below the diagonal, to v.
void DenseFactor::add_multiple(Index column, float sign, FloatColumns v) const
{
    const Index next = column + 1;
    add_column(below(column), at(n_ - next), sign * v.x[column], sign * v.y[column], sign * v.z[column], v.x + next,
               v.y + next, v.z + next);
}

/// Adds sign · (the column of L, below the diagonal) · v to v_column.
void DenseFactor::add_product(Index column, float sign, FloatColumns v) const
{
    const Index next = column + 1;
    float products[3];
    multiply_column(below(column), at(n_ - next), v.x + next, v.y + next, v.z + next, products);
    v.x[column] += sign * products[0];
    v.y[column] += sign * products[1];
    v.z[column] += sign * products[2];
}

void DenseFactor::multiply(FloatColumns v) const
{
    multiply_by_root_transposed(v);
    multiply_by_root(v);
}

void DenseFactor::multiply_by_root_transposed(FloatColumns v) const
{
    // Row j of Lᵀ v needs those after it, so that columns in ascending order may write over it.
    for (Index column = 0; column < n_; ++column)
        add_product(column, 1.0F, v);
    multiply_by_diagonal(root_, v);
}

void DenseFactor::multiply_by_root(FloatColumns v) const
{
    multiply_by_diagonal(root_, v);
    for (Index column = n_ - 1; column >= 0; --column)
        add_multiple(column, 1.0F, v);
}

void DenseFactor::solve(FloatColumns v) const
{
    for (Index column = 0; column < n_; ++column)
        add_multiple(column, -1.0F, v);
    multiply_by_diagonal(inverse_, v);
    for (Index column = n_ - 1; column >= 0; --column)
        add_product(column, -1.0F, v);
}

std::vector<double> DenseFactor::diagonal() const
{
    std::vector<double> sums(at(n_));
    for (Index column = 0; column < n_; ++column) {
        const double pivot = scale_ / static_cast<double>(inverse_[at(column)]);
        sums[at(column)] += pivot;
        for (Index row = column + 1; row < n_; ++row) {
            const auto value = static_cast<double>(below(column)[row - column - 1]);
            sums[at(row)] += value * value * pivot;
        }
    }
    return sums;
}

}  // namespace seamflow
