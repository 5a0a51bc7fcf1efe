#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/systems/symmetric_matrix.h"

using namespace seamflow;

namespace {

// Unknowns 0 … 3 are vertices 1, 2, 4 and 5; 3 is known, 6 beyond.
const std::vector<Index> unknown_of{-1, 0, 1, -1, 2, 3};
const std::vector<VertexPair> pairs{{1, 2}, {2, 4}, {3, 4}, {4, 2}, {5, 6}, {1, 4}, {2, 1}, {0, 3}};

}  // namespace

TEST_CASE("unknowns have each neighbour once, however often they make a pair")
{
    const SparsePattern neighbours = neighbours_of(pairs_of_unknowns(pairs, unknown_of, 4));
    CHECK(neighbours.column_offsets == std::vector<Index>{0, 2, 4, 6, 6});
    const auto rows_of = [&](Index u) {
        std::vector<Index> rows(neighbours.rows.begin() + neighbours.column_offsets[u],
                                neighbours.rows.begin() + neighbours.column_offsets[u + 1]);
        std::sort(rows.begin(), rows.end());
        return rows;
    };
    CHECK(rows_of(0) == std::vector<Index>{1, 2});
    CHECK(rows_of(1) == std::vector<Index>{0, 2});
    CHECK(rows_of(2) == std::vector<Index>{0, 1});
}

TEST_CASE("the upper triangle has its rows in ascending order, in any order of the unknowns, and all pairs their slots")
{
    const PairsOfUnknowns of = pairs_of_unknowns(pairs, unknown_of, 4);
    std::vector<Index> order{0, 1, 2, 3};
    do {
        const auto [pattern, slots] = upper_pattern(of, order);
        CHECK(pattern.n() == 4);
        CHECK(pattern.n_entries() == 7);
        for (Index column = 0; column < 4; ++column) {
            CHECK(std::is_sorted(pattern.rows.begin() + pattern.column_offsets[column],
                                 pattern.rows.begin() + pattern.column_offsets[column + 1]));
            CHECK(pattern.rows[pattern.column_offsets[column + 1] - 1] == column);
        }
        const auto number_of = [&](Index vertex) {
            return static_cast<Index>(std::find(order.begin(), order.end(), unknown_of[vertex]) - order.begin());
        };
        REQUIRE(slots.size() == pairs.size());
        for (const std::size_t i : {0U, 1U, 3U, 5U, 6U}) {
            const Index a = number_of(pairs[i].first);
            const Index b = number_of(pairs[i].second);
            CHECK(slots[i] == pattern.slot({std::max(a, b), std::min(a, b)}));
        }
        for (const std::size_t i : {2U, 4U, 7U})
            CHECK(slots[i] == -1);
    } while (std::next_permutation(order.begin(), order.end()));
}
