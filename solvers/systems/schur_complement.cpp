#include "solvers/systems/schur_complement.h"

#include <algorithm>

#include "partition/vector_area.h"
#include "solvers/direct/simd.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// How far ahead rows of the factor are asked for, and in what portions, in numbers.
constexpr Index rows_ahead = 6;
constexpr Index cache_line = 64 / sizeof(double);

/// v[0 … n - 1] += row[0 … n - 1] · factor, for three columns.
SEAMFLOW_WIDE void add_row(const double* __restrict row, Index n, const Point& factor, Columns& v)
{
    for (Eigen::Index c = 0; c < 3; ++c) {
        double* __restrict column = v.col(c).data();
        const double f = factor[c];
        for (Index j = 0; j < n; ++j)
            column[j] += row[j] * f;
    }
}

/// row[0 … n - 1] · v[0 … n - 1], for three columns; by four sums each, as wide registers have them.
SEAMFLOW_WIDE Point multiply_row(const double* __restrict row, Index n, const Columns& v)
{
    Point result;
    for (Eigen::Index c = 0; c < 3; ++c) {
        const double* __restrict column = v.col(c).data();
        double sums[4] = {};
        const Index n_whole = n / 4 * 4;
        for (Index j = 0; j < n_whole; j += 4)
            for (Index k = 0; k < 4; ++k)
                sums[k] += row[j + k] * column[j + k];
        for (Index j = n_whole; j < n; ++j)
            sums[0] += row[j] * column[j];
        result[c] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    }
    return result;
}

}  // namespace

void SchurComplement::take(const LdlSolver::Factor& factor, Storage storage)
{
    const DenseLdl last = factor.last();
    single_.take(last);
    rows_ = last.data();
    is_packed_ = storage == Storage::Copy;
    if (!is_packed_)
        return;
    packed_.resize(packed_begin(n()));
    for (Index i = 0; i < n(); ++i)
        std::copy_n(last.row(i).data(), i + 1, packed_.begin() + static_cast<std::ptrdiff_t>(packed_begin(i)));
    rows_ = packed_.data();
}

void SchurComplement::subtract_product(const Eigen::Ref<const Points>& x, Eigen::Ref<Points> result) const
{
    Columns scaled = x;
    for (Index i = 0; i < n(); ++i) {
        // Rows of the factor end before the memory between them does, which processors do not foresee.
        const Index next = std::min(i + rows_ahead, n() - 1);
        for (Index j = 0; j <= next; j += cache_line)
            __builtin_prefetch(row(next) + j);
        add_row(row(i), i, x.row(i), scaled);
    }
    for (Index i = 0; i < n(); ++i)
        scaled.row(i) *= row(i)[i];
    for (Index i = 0; i < n(); ++i)
        result.row(i) -= scaled.row(i) + multiply_row(row(i), i, scaled);
}

}  // namespace seamflow
