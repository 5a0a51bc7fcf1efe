#include "solvers/interface/dense_factor.h"

#include <algorithm>

namespace seamflow {

namespace {

// The same operations on every machine, in wider registers where it has them.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define SEAMFLOW_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define SEAMFLOW_WIDE
#endif

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

void scale(const std::vector<float>& diagonal, FloatColumns v)
{
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
        v.x[i] *= diagonal[i];
        v.y[i] *= diagonal[i];
        v.z[i] *= diagonal[i];
    }
}

}  // namespace

void DenseFactor::take_last(const TriangularFactor& factor, Index n)
{
    n_ = n;
    values_.assign(at(n) * at(n), 0.0F);
    diagonal_.resize(at(n));
    inverse_.resize(at(n));
    const Index first = static_cast<Index>(factor.offsets.size()) - n;
    for (Index column = 0; column < n; ++column) {
        const int begin = factor.offsets[at(first + column)];
        const int end = begin + factor.counts[at(first + column)];
        diagonal_[at(column)] = static_cast<float>(factor.values[begin]);
        inverse_[at(column)] = static_cast<float>(1.0 / factor.values[begin]);
        for (int e = begin + 1; e < end; ++e) {
            const Index row = factor.rows[e] - first;
            values_[at(column) * at(n) + at(row)] = static_cast<float>(factor.values[e]);
            values_[at(row) * at(n) + at(column)] = static_cast<float>(factor.values[e]);
        }
    }
}

void DenseFactor::multiply(FloatColumns v) const
{
    // Lᵀ v: row j of the result needs those after it, so that columns in ascending order may write over it.
    for (Index column = 0; column < n_; ++column)
        add_column(&values_[at(column) * at(n_)], 0, column, v.x[column], v.y[column], v.z[column], v.x, v.y, v.z);
    scale(diagonal_, v);
    for (Index column = n_ - 1; column >= 0; --column)
        add_column(&values_[at(column) * at(n_)], column + 1, n_, v.x[column], v.y[column], v.z[column], v.x, v.y, v.z);
}

void DenseFactor::solve(FloatColumns v) const
{
    for (Index column = 0; column < n_; ++column)
        add_column(&values_[at(column) * at(n_)], column + 1, n_, -v.x[column], -v.y[column], -v.z[column], v.x, v.y,
                   v.z);
    scale(inverse_, v);
    for (Index column = n_ - 1; column >= 0; --column)
        add_column(&values_[at(column) * at(n_)], 0, column, -v.x[column], -v.y[column], -v.z[column], v.x, v.y, v.z);
}

}  // namespace seamflow
