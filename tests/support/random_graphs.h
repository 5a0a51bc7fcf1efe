#pragma once

#include <vector>

#include "samples/meshes/random_numbers.h"
#include "solvers/sparse/sparse_pattern.h"

namespace seamflow::test {

/// A graph of n vertices and about so many edges: of each vertex its neighbours.
inline SparsePattern random_neighbours(Index n, Index n_edges, RandomNumbers& random)
{
    std::vector<MatrixEntry> entries;
    for (Index i = 0; i < n_edges; ++i) {
        const Index a = random.below(n);
        const Index b = random.below(n);
        if (a != b)
            entries.insert(entries.end(), {{a, b}, {b, a}});
    }
    return make_pattern(n, entries);
}

/// Squares with one of their diagonals, some left out: of each vertex its neighbours.
inline SparsePattern triangle_neighbours(Index side, RandomNumbers& random)
{
    std::vector<MatrixEntry> entries;
    const auto join = [&](Index a, Index b) {
        if (random.below(10) > 0)
            entries.insert(entries.end(), {{a, b}, {b, a}});
    };
    for (Index y = 0; y < side; ++y)
        for (Index x = 0; x < side; ++x) {
            const Index v = y * side + x;
            if (x + 1 < side)
                join(v, v + 1);
            if (y + 1 < side)
                join(v, v + side);
            if (x + 1 < side && y + 1 < side)
                join(v, v + side + 1);
        }
    return make_pattern(side * side, entries);
}

/// Every vertex but the first few has one to three of these as neighbours, and no others.
inline SparsePattern star_neighbours(Index n, Index n_hubs, RandomNumbers& random)
{
    std::vector<MatrixEntry> entries;
    for (Index v = n_hubs; v < n; ++v)
        for (Index i = random.below(3); i >= 0; --i) {
            const Index hub = random.below(n_hubs);
            entries.insert(entries.end(), {{v, hub}, {hub, v}});
        }
    return make_pattern(n, entries);
}

/// Each vertex but the first has one before it as its neighbour.
inline SparsePattern tree_neighbours(Index n, RandomNumbers& random)
{
    std::vector<MatrixEntry> entries;
    for (Index v = 1; v < n; ++v) {
        const Index other = random.below(v);
        entries.insert(entries.end(), {{v, other}, {other, v}});
    }
    return make_pattern(n, entries);
}

/// On and above the diagonal of the matrix with these entries off the diagonal, its unknowns in the order given.
inline SparsePattern upper_in(const SparsePattern& neighbours, const std::vector<Index>& order)
{
    std::vector<Index> number_of(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        number_of[order[i]] = static_cast<Index>(i);
    std::vector<MatrixEntry> entries;
    for (Index u = 0; u < neighbours.n(); ++u) {
        entries.push_back({u, u});
        for (Index k = neighbours.column_offsets[u]; k < neighbours.column_offsets[u + 1]; ++k)
            if (const Index other = neighbours.rows[k]; number_of[other] > number_of[u])
                entries.push_back({number_of[other], number_of[u]});
    }
    return make_pattern(neighbours.n(), entries);
}

}  // namespace seamflow::test
