#include "solvers/sparse_pattern.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

#include "partition/errors.h"

namespace seamflow {

Index SparsePattern::slot(MatrixEntry entry) const
{
    const auto first = rows.begin() + column_offsets[at(entry.column)];
    const auto last = rows.begin() + column_offsets[at(entry.column) + 1];
    const auto found = std::lower_bound(first, last, entry.row);
    assert(found != last && *found == entry.row && "the pattern has the entry");
    return static_cast<Index>(found - rows.begin());
}

SparsePattern make_pattern(Index n, std::vector<MatrixEntry> entries)
{
    std::sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
    if (entries.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
        throw ComputationError("a system of " + std::to_string(n) +
                               " unknowns has too many entries: cut the mesh into more sub-meshes");
    SparsePattern pattern;
    pattern.column_offsets.assign(at(n) + 1, 0);
    pattern.rows.reserve(entries.size());
    for (const MatrixEntry& entry : entries) {
        ++pattern.column_offsets[at(entry.column) + 1];
        pattern.rows.push_back(entry.row);
    }
    for (std::size_t column = 0; column < at(n); ++column)
        pattern.column_offsets[column + 1] += pattern.column_offsets[column];
    return pattern;
}

}  // namespace seamflow
