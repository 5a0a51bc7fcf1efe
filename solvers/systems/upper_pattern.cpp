#include "solvers/systems/upper_pattern.h"

namespace seamflow {

SparsePattern upper_pattern(const std::vector<VertexPair>& pairs, const std::vector<Index>& unknown_of, Index n)
{
    std::vector<MatrixEntry> entries;
    entries.reserve(pairs.size() + at(n));
    for (const auto [a, b] : pairs) {
        const auto n_own = static_cast<Index>(unknown_of.size());
        if (a < n_own && b < n_own && unknown_of[at(a)] >= 0 && unknown_of[at(b)] >= 0)
            entries.push_back(upper_entry(unknown_of[at(a)], unknown_of[at(b)]));
    }
    for (Index u = 0; u < n; ++u)
        entries.push_back({u, u});
    return make_pattern(n, entries);
}

}  // namespace seamflow
