#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solvers/laplacian/symmetric_laplacian.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow {

/// A coefficient of an unknown's row at a vertex that is known.
struct Coupling {
    Index unknown = 0;
    Index vertex = 0;
    double value = 0.0;
};

/// Of each unknown the pairs that it makes with others, from either end.
struct PairsOfUnknowns {
    struct Entry {
        Index other;
        Index pair;
    };
    /// n + 1.
    std::vector<Index> offsets;
    std::vector<Entry> entries;
    /// Number of all pairs, those among them of which not both are unknown.
    std::size_t n_pairs = 0;

    [[nodiscard]] Index n() const { return static_cast<Index>(offsets.size()) - 1; }
};

/// @param unknown_of per vertex, or -1; vertices beyond its end are not unknown.
/// @param n number of unknowns.
/// @throws ComputationError if there are 2³¹ numbers to be kept or more, two for each pair and one for each unknown.
PairsOfUnknowns pairs_of_unknowns(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n);

/// All entries off the diagonal of the symmetric matrix, each once; rows in any order.
SparsePattern neighbours_of(const PairsOfUnknowns& pairs);

/// The upper triangle of the symmetric matrix, its diagonal included, and where pairs of vertices stand in it.
struct UpperPattern {
    SparsePattern pattern;
    /// Per pair: its entry; -1 where not both are unknown.
    std::vector<Index> slots;
};

/// @param order the unknowns in the order in which the matrix has them.
UpperPattern upper_pattern(const PairsOfUnknowns& pairs, const std::vector<Index>& order);

/// The entry of an unknown on the diagonal, which is the last of its column.
/// @param column_offsets those of the upper triangle.
inline Index diagonal_slot(std::span<const Index> column_offsets, Index unknown)
{
    return column_offsets[unknown + 1] - 1;
}

}  // namespace seamflow
