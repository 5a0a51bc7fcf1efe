#include "solvers/sparse_pattern.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <string>

#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// The rows of the entries in each column, in no order and with their repetitions.
IndexLists by_columns(Index n, const std::vector<MatrixEntry>& entries)
{
    if (entries.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
        throw ComputationError("a system of " + std::to_string(n) +
                               " unknowns has too many entries: cut the mesh into more sub-meshes");
    IndexLists columns;
    columns.offsets.assign(at(n) + 1, 0);
    for (const MatrixEntry& entry : entries)
        ++columns.offsets[at(entry.column) + 1];
    std::partial_sum(columns.offsets.begin(), columns.offsets.end(), columns.offsets.begin());
    columns.values.resize(entries.size());
    std::vector<Index> next = columns.offsets;
    for (const MatrixEntry& entry : entries)
        columns.values[at(next[at(entry.column)]++)] = entry.row;
    return columns;
}

}  // namespace

Index SparsePattern::slot(MatrixEntry entry) const
{
    const auto first = rows.begin() + column_offsets[at(entry.column)];
    const auto last = rows.begin() + column_offsets[at(entry.column) + 1];
    const auto found = std::lower_bound(first, last, entry.row);
    assert(found != last && *found == entry.row && "the pattern has the entry");
    return static_cast<Index>(found - rows.begin());
}

SparsePattern make_pattern(Index n, const std::vector<MatrixEntry>& entries)
{
    IndexLists columns = by_columns(n, entries);
    SparsePattern pattern;
    for (Index column = 0; column < n; ++column) {
        const auto first = columns.values.begin() + columns.offsets[at(column)];
        const auto last = columns.values.begin() + columns.offsets[at(column) + 1];
        std::sort(first, last);
        pattern.column_offsets.push_back(pattern.column_offsets.back() +
                                         static_cast<Index>(std::unique(first, last) - first));
    }
    pattern.rows.reserve(at(pattern.column_offsets.back()));
    for (Index column = 0; column < n; ++column) {
        const auto rows = columns[column];
        const Index n_rows = pattern.column_offsets[at(column) + 1] - pattern.column_offsets[at(column)];
        pattern.rows.insert(pattern.rows.end(), rows.begin(), rows.begin() + n_rows);
    }
    return pattern;
}

}  // namespace seamflow
