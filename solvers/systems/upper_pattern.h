#pragma once

#include <span>
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

/// The upper triangle of a symmetric matrix, its diagonal included, and where pairs of vertices stand in it.
struct UpperPattern {
    SparsePattern pattern;
    /// Per pair: its entry; -1 where not both are unknown.
    std::vector<Index> slots;
};

/// @param unknown_of per vertex, or -1; vertices beyond its end are not unknown.
/// @param n number of unknowns.
/// @throws ComputationError if there are 2³¹ entries or more.
UpperPattern upper_pattern(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n);

/// The entry of an unknown on the diagonal, which is the last of its column.
/// @param column_offsets those of the upper triangle.
inline Index diagonal_slot(std::span<const Index> column_offsets, Index unknown)
{
    return column_offsets[at(unknown) + 1] - 1;
}

}  // namespace seamflow
