#include "solvers/interface/dense_factor.h"

#include <algorithm>
#include <cmath>

#include "solvers/interface/power_of_two.h"
#include "solvers/wide.h"

namespace seamflow {

namespace {

/// v[begin …] += factor · column[begin …], for three vectors at once.
SEAMFLOW_WIDE void add_column(const float* __restrict column, Index begin, Index end, float factor_x, float factor_y,
                              float factor_z, float* __restrict x, float* __restrict y, float* __restrict z)
{
    for (Index i = begin; i < end; ++i) {
        x[i] += factor_x * column[i];
        y[i] += factor_y * column[i];
        z[i] += factor_z * column[i];
    }
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
    values_.resize(at(n_) * at(n_));
    root_.resize(at(n_));
    inverse_.resize(at(n_));
    scale_ = n_ > 0 ? power_of_two_near(factor.diagonal().maxCoeff()) : 1.0;
    for (Index row = 0; row < n_; ++row) {
        for (Index column = 0; column < row; ++column) {
            const auto value = static_cast<float>(factor(row, column));
            values_[at(column) * at(n_) + at(row)] = value;
            values_[at(row) * at(n_) + at(column)] = value;
        }
        values_[at(row) * at(n_) + at(row)] = 0.0F;
        const double pivot = factor(row, row) / scale_;
        root_[at(row)] = static_cast<float>(std::sqrt(pivot));
        inverse_[at(row)] = static_cast<float>(1.0 / pivot);
    }
}

void DenseFactor::multiply(FloatColumns v) const
{
    multiply_by_root_transposed(v);
    multiply_by_root(v);
}

void DenseFactor::multiply_by_root_transposed(FloatColumns v) const
{
    // Lᵀ v: row j of the result needs those after it, so that columns in ascending order may write over it.
    for (Index column = 0; column < n_; ++column)
        add_column(&values_[at(column) * at(n_)], 0, column, v.x[column], v.y[column], v.z[column], v.x, v.y, v.z);
    multiply_by_diagonal(root_, v);
}

void DenseFactor::multiply_by_root(FloatColumns v) const
{
    multiply_by_diagonal(root_, v);
    for (Index column = n_ - 1; column >= 0; --column)
        add_column(&values_[at(column) * at(n_)], column + 1, n_, v.x[column], v.y[column], v.z[column], v.x, v.y, v.z);
}

void DenseFactor::solve(FloatColumns v) const
{
    for (Index column = 0; column < n_; ++column)
        add_column(&values_[at(column) * at(n_)], column + 1, n_, -v.x[column], -v.y[column], -v.z[column], v.x, v.y,
                   v.z);
    multiply_by_diagonal(inverse_, v);
    for (Index column = n_ - 1; column >= 0; --column)
        add_column(&values_[at(column) * at(n_)], 0, column, -v.x[column], -v.y[column], -v.z[column], v.x, v.y, v.z);
}

std::vector<double> DenseFactor::diagonal() const
{
    std::vector<double> sums(at(n_));
    for (Index column = 0; column < n_; ++column) {
        const double pivot = scale_ / static_cast<double>(inverse_[at(column)]);
        sums[at(column)] += pivot;
        for (Index row = column + 1; row < n_; ++row) {
            const auto value = static_cast<double>(values_[at(column) * at(n_) + at(row)]);
            sums[at(row)] += value * value * pivot;
        }
    }
    return sums;
}

}  // namespace seamflow
