#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "solvers/sparse/sparse_pattern.h"

using namespace seamflow;

TEST_CASE("entries come in any order and as often as they like")
{
    const SparsePattern pattern = make_pattern(4, {{2, 3}, {0, 1}, {2, 0}, {0, 1}, {3, 3}, {0, 0}, {2, 3}});
    CHECK(pattern.n() == 4);
    CHECK(pattern.n_entries() == 5);
    CHECK(pattern.column_offsets == std::vector<Index>{0, 2, 2, 4, 5});
    CHECK(pattern.rows == std::vector<Index>{0, 1, 0, 3, 3});
}

TEST_CASE("a pattern without entries has columns all the same")
{
    CHECK(make_pattern(3, {}).column_offsets == std::vector<Index>{0, 0, 0, 0});
    CHECK(make_pattern(0, {}).n() == 0);
    CHECK(SparsePattern{}.n() == 0);
}

TEST_CASE("the slots of a pattern are its entries in order")
{
    RandomNumbers random(7);
    std::vector<MatrixEntry> entries;
    for (int i = 0; i < 400; ++i)
        entries.push_back({random.below(40), random.below(40)});
    const SparsePattern pattern = make_pattern(40, entries);
    for (const MatrixEntry& entry : entries) {
        const Index slot = pattern.slot(entry);
        CHECK(pattern.rows[slot] == entry.row);
        CHECK(slot >= pattern.column_offsets[entry.column]);
        CHECK(slot < pattern.column_offsets[entry.column + 1]);
    }
}
