#include "solvers/systems/upper_pattern.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "partition/errors.h"

namespace seamflow {

namespace {

/// A pair as an entry above the diagonal.
struct PairEntry {
    Index row;
    Index column;
    Index pair;
};

/// The pairs of unknowns.
std::vector<PairEntry> entries_of(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of)
{
    const auto n_own = static_cast<Index>(unknown_of.size());
    const auto unknown = [&](Index v) { return v < n_own ? unknown_of[at(v)] : -1; };
    std::vector<PairEntry> entries;
    entries.reserve(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Index a = unknown(pairs[i].first);
        const Index b = unknown(pairs[i].second);
        if (a >= 0 && b >= 0)
            entries.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(i)});
    }
    return entries;
}

/// Sorts by one of the members, which is below n; stable, and in linear time.
void sort_by(Index PairEntry::*key, Index n, std::vector<PairEntry>& entries)
{
    std::vector<Index> next(at(n) + 1, 0);
    for (const PairEntry& entry : entries)
        ++next[at(entry.*key) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<PairEntry> sorted(entries.size());
    for (const PairEntry& entry : entries)
        sorted[at(next[at(entry.*key)]++)] = entry;
    entries = std::move(sorted);
}

}  // namespace

UpperPattern upper_pattern(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n)
{
    if (pairs.size() > at(std::numeric_limits<Index>::max() - n))
        throw ComputationError("a system of " + std::to_string(n) +
                               " unknowns has too many entries: cut the mesh into more sub-meshes");
    std::vector<PairEntry> entries = entries_of(pairs, unknown_of);
    sort_by(&PairEntry::row, n, entries);
    sort_by(&PairEntry::column, n, entries);

    // Not all at once: where memory lacks for a later member, GCC 12 destroys twice what it has made of {}.
    UpperPattern upper;
    upper.slots.assign(pairs.size(), -1);
    auto& [offsets, rows] = upper.pattern;
    offsets.reserve(at(n) + 1);
    rows.reserve(entries.size() + at(n));
    auto entry = entries.begin();
    for (Index column = 0; column < n; ++column) {
        for (; entry != entries.end() && entry->column == column; ++entry) {
            if (static_cast<Index>(rows.size()) == offsets.back() || rows.back() != entry->row)
                rows.push_back(entry->row);
            upper.slots[at(entry->pair)] = static_cast<Index>(rows.size()) - 1;
        }
        rows.push_back(column);
        offsets.push_back(static_cast<Index>(rows.size()));
    }
    rows.shrink_to_fit();
    return upper;
}

}  // namespace seamflow
