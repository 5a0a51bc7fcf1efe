#pragma once

#include <algorithm>
#include <vector>

#include "solvers/laplacian/symmetric_laplacian.h"
#include "solvers/sparse_pattern.h"

namespace seamflow {

/// A coefficient of an unknown's row at a vertex that is known.
struct Coupling {
    Index unknown = 0;
    Index vertex = 0;
    double value = 0.0;
};

/// The entry of two unknowns on or above the diagonal.
inline MatrixEntry upper_entry(Index a, Index b)
{
    return {std::max(a, b), std::min(a, b)};
}

/// The upper triangle of a symmetric matrix, its diagonal included.
/// @param unknown_of per vertex, or -1; vertices beyond its end are not unknown.
/// @param n number of unknowns.
SparsePattern upper_pattern(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n);

}  // namespace seamflow
