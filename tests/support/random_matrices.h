#pragma once

#include <vector>

#include "samples/meshes/random_numbers.h"
#include "solvers/direct/columns.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow::test {

/// About five entries a row, on the diagonal among them, in a pattern that is not symmetric.
inline SparsePattern random_pattern(Index n, RandomNumbers& random)
{
    std::vector<MatrixEntry> entries;
    for (Index row = 0; row < n; ++row) {
        entries.push_back({row, row});
        for (int i = 0; i < 4; ++i)
            entries.push_back({random.below(n), row});
    }
    return make_pattern(n, entries);
}

/// Random values, the diagonal large enough for a well-conditioned matrix.
inline std::vector<double> random_values(const SparsePattern& pattern, RandomNumbers& random)
{
    std::vector<double> values(pattern.n_entries());
    for (double& value : values)
        value = random.symmetric();
    for (Index i = 0; i < pattern.n(); ++i)
        values[pattern.slot({i, i})] += 6.0;
    return values;
}

/// A dense matrix whose pivots on the diagonal, 0.002 below entries of 1, let entries grow 500-fold for each: large
/// enough to be taken where a thousandth of the largest will do, and to lose all digits.
struct GrowingMatrix {
    SparsePattern pattern;
    std::vector<double> values;
};

inline GrowingMatrix growing_matrix(Index n)
{
    std::vector<MatrixEntry> entries;
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
            entries.push_back({i, j});
    GrowingMatrix matrix{.pattern = make_pattern(n, entries), .values = std::vector<double>(entries.size())};
    for (const auto& [i, j] : entries)
        matrix.values[matrix.pattern.slot({i, j})] = i == j ? 0.002 : i > j ? -1.0 : j == n - 1 ? 1.0 : 0.0;
    return matrix;
}

inline Columns random_columns(Index n, RandomNumbers& random)
{
    Columns columns(n, 3);
    for (double& entry : columns.reshaped())
        entry = random.symmetric();
    return columns;
}

}  // namespace seamflow::test
