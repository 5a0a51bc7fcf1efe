#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "tests/support/random_matrices.h"

namespace seamflow::test {

/// A symmetric matrix by its entries on and above the diagonal, and written out.
struct SymmetricMatrix {
    SparsePattern upper;
    std::vector<double> values;
    Eigen::MatrixXd dense;
};

/// A grid's Laplacian plus `shift` on the diagonal, with random weights.
inline SymmetricMatrix grid_matrix(Index side, double shift, RandomNumbers& random)
{
    const Index n = side * side;
    SymmetricMatrix matrix;
    matrix.dense = shift * Eigen::MatrixXd::Identity(n, n);
    std::vector<MatrixEntry> entries;
    const auto add_edge = [&](Index a, Index b) {
        const double weight = 1.5 + random.symmetric();
        entries.push_back({std::max(a, b), std::min(a, b)});
        matrix.dense(a, b) -= weight;
        matrix.dense(b, a) -= weight;
        matrix.dense(a, a) += weight;
        matrix.dense(b, b) += weight;
    };
    for (Index y = 0; y < side; ++y)
        for (Index x = 0; x < side; ++x) {
            entries.push_back({y * side + x, y * side + x});
            if (x + 1 < side)
                add_edge(y * side + x, y * side + x + 1);
            if (y + 1 < side)
                add_edge(y * side + x, (y + 1) * side + x);
        }
    matrix.upper = make_pattern(n, entries);
    for (Index column = 0; column < n; ++column)
        for (Index k = matrix.upper.column_offsets[column]; k < matrix.upper.column_offsets[column + 1]; ++k)
            matrix.values.push_back(matrix.dense(matrix.upper.rows[k], column));
    return matrix;
}

}  // namespace seamflow::test
