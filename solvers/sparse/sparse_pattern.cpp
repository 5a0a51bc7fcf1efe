#include "solvers/sparse/sparse_pattern.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

#include "partition/errors.h"
#include "partition/index_lists.h"

namespace seamflow {

Index SparsePattern::slot(MatrixEntry entry) const
{
    const auto first = rows.begin() + column_offsets[entry.column];
    const auto last = rows.begin() + column_offsets[entry.column + 1];
    const auto found = std::lower_bound(first, last, entry.row);
    assert(found != last && *found == entry.row && "the pattern has the entry");
    return static_cast<Index>(found - rows.begin());
}

namespace {

/// Removes repeated entries, and sorts the rows of each column.
void leave_one_of_each(SparsePattern& pattern)
{
    auto end = pattern.rows.begin();
    for (std::size_t column = 0; column + 1 < pattern.column_offsets.size(); ++column) {
        const auto first = pattern.rows.begin() + pattern.column_offsets[column];
        const auto last = pattern.rows.begin() + pattern.column_offsets[column + 1];
        pattern.column_offsets[column] = static_cast<Index>(end - pattern.rows.begin());
        std::sort(first, last);
        end = std::unique_copy(first, last, end);
    }
    pattern.column_offsets.back() = static_cast<Index>(end - pattern.rows.begin());
    pattern.rows.erase(end, pattern.rows.end());
    pattern.rows.shrink_to_fit();
}

}  // namespace

SparsePattern make_pattern(Index n, const std::vector<MatrixEntry>& entries)
{
    if (entries.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
        throw ComputationError("a system of " + std::to_string(n) +
                               " unknowns has too many entries: cut the mesh into more sub-meshes");
    IndexLists columns = make_lists(n, [&](auto&& add) {
        for (const MatrixEntry& entry : entries)
            add(entry.column, entry.row);
    });
    SparsePattern pattern{std::move(columns.offsets), std::move(columns.values)};
    leave_one_of_each(pattern);
    return pattern;
}

}  // namespace seamflow
