#pragma once

#include <vector>

#include "partition/index.h"

namespace seamflow {

/// The position of an entry in a matrix. Ordered by column, then row.
struct MatrixEntry {
    Index column = 0;
    Index row = 0;
    friend auto operator<=>(const MatrixEntry&, const MatrixEntry&) = default;
};

/// The entries of a square matrix that may be nonzero, by columns. Values are kept separately, in an array with one
/// number per entry in the same order.
struct SparsePattern {
    /// n + 1: the index of the first entry of each column, and the number of entries.
    std::vector<Index> column_offsets{0};
    /// The rows of each column's entries, ascending unless stated otherwise.
    std::vector<Index> rows;

    [[nodiscard]] Index n() const { return static_cast<Index>(column_offsets.size()) - 1; }
    [[nodiscard]] Index n_entries() const { return static_cast<Index>(rows.size()); }

    /// The index of an entry among the values.
    /// @pre the pattern has the entry.
    [[nodiscard]] Index slot(MatrixEntry entry) const;
};

/// The pattern of an n by n matrix with these entries, in any order, maybe repeated.
/// @throws ComputationError if 2³¹ or more entries are given.
SparsePattern make_pattern(Index n, const std::vector<MatrixEntry>& entries);

}  // namespace seamflow
