#include <algorithm>
#include <functional>
#include <numeric>
#include <set>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "solvers/sparse/symbolic_factor.h"
#include "tests/support/random_graphs.h"
#include "tests/support/random_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// Which entries of L are different from zero, found by eliminating one unknown after the other.
Eigen::MatrixXi eliminated(const SparsePattern& pattern, const std::vector<Index>& position)
{
    const Index n = pattern.n();
    Eigen::MatrixXi filled = Eigen::MatrixXi::Identity(n, n);
    for (Index column = 0; column < n; ++column)
        for (Index k = pattern.column_offsets[column]; k < pattern.column_offsets[column + 1]; ++k) {
            filled(position[pattern.rows[k]], position[column]) = 1;
            filled(position[column], position[pattern.rows[k]]) = 1;
        }
    for (Index pivot = 0; pivot < n; ++pivot)
        for (Index row = pivot + 1; row < n; ++row)
            for (Index column = pivot + 1; column < n; ++column)
                filled(row, column) |= filled(row, pivot) & filled(pivot, column);
    return filled.triangularView<Eigen::Lower>();
}

/// The entries of L as the blocks have them.
Eigen::MatrixXi from_blocks(const SymbolicFactor& factor)
{
    Eigen::MatrixXi filled = Eigen::MatrixXi::Zero(factor.n(), factor.n());
    for (Index b = 0; b < factor.n_supernodes(); ++b)
        for (Index c = 0; c < factor.width(b); ++c)
            for (const Index row : factor.rows[b].subspan(c))
                filled(row, factor.first[b] + c) = 1;
    return filled;
}

/// Every entry's column stands where it is said among the rows of its row's block.
void check_places(const SparsePattern& upper, const SymbolicFactor& factor, const std::vector<Index>& places)
{
    REQUIRE(places.size() == upper.rows.size());
    for (Index column = 0; column < upper.n(); ++column)
        for (Index k = upper.column_offsets[column]; k < upper.column_offsets[column + 1]; ++k) {
            Index block = 0;
            while (factor.first[block + 1] <= upper.rows[k])
                ++block;
            CHECK(factor.rows[block][places[k]] == column);
        }
}

}  // namespace

TEST_CASE("the blocks have exactly the entries that elimination fills in")
{
    RandomNumbers random(1);
    for (const Index n : {1, 2, 9, 60}) {
        const SparsePattern pattern = random_pattern(n, random);
        const SymbolicFactor factor = make_symbolic_factor(pattern);
        std::vector<Index> position = factor.position;
        CHECK(from_blocks(factor) == eliminated(pattern, position));
        std::sort(position.begin(), position.end());
        for (Index i = 0; i < n; ++i)
            CHECK(position[i] == i);
        if (n > 2)
            CHECK(factor.n_supernodes() < n);
    }
}

TEST_CASE("an unknown is updated once by each earlier block that has a row there")
{
    RandomNumbers random(2);
    const SymbolicFactor factor = make_symbolic_factor(random_pattern(60, random));
    std::size_t n_expected = 0;
    for (Index b = 0; b < factor.n_supernodes(); ++b) {
        CHECK(std::is_sorted(factor.rows[b].begin(), factor.rows[b].end()));
        n_expected += factor.rows[b].size() - usize(factor.width(b));
    }
    CHECK(factor.updates.size() == n_expected);
    for (Index u = 0; u < factor.n(); ++u) {
        std::set<Index> blocks;
        for (Index k = factor.update_offsets[u]; k < factor.update_offsets[u + 1]; ++k) {
            const auto [block, place] = factor.updates[k];
            CHECK(blocks.insert(block).second);
            CHECK(place >= factor.width(block));
            CHECK(factor.rows[block][place] == u);
        }
    }
}

TEST_CASE("a pattern without unknowns has no blocks")
{
    CHECK(make_symbolic_factor(SparsePattern{}).n_supernodes() == 0);
}

TEST_CASE("in a given order the last unknowns are one block, and the others have the entries that elimination fills "
          "in, and few more")
{
    RandomNumbers random(3);
    for (const Index n_last : {0, 1, 7, 30}) {
        std::vector<MatrixEntry> entries;
        for (Index i = 0; i < 30; ++i) {
            entries.push_back({i, i});
            for (int k = 0; k < 2; ++k) {
                const Index j = random.below(30);
                entries.push_back({std::max(i, j), std::min(i, j)});
            }
        }
        const SparsePattern upper = make_pattern(30, entries);
        std::vector<Index> places;
        const SymbolicFactor factor = make_symmetric_symbolic_factor(upper, n_last, {}, places);
        std::vector<Index> as_they_are(30);
        std::iota(as_they_are.begin(), as_they_are.end(), 0);
        Eigen::MatrixXi expected = eliminated(upper, as_they_are);
        expected.bottomRightCorner(n_last, n_last).triangularView<Eigen::Lower>().setOnes();
        const Eigen::MatrixXi found = from_blocks(factor);
        CHECK((found.array() >= expected.array()).all());
        CHECK(found.sum() <= 2 * expected.sum());
        if (n_last > 0)
            CHECK(factor.width(factor.n_supernodes() - 1) == n_last);
        CHECK(factor.updates.empty());
        check_places(upper, factor, places);
    }
}

TEST_CASE("with the tree that comes with an elimination ordering, blocks have the entries that are filled in, and few "
          "more")
{
    RandomNumbers random(4);
    for (const SparsePattern& neighbours :
         {random_neighbours(1, 0, random), random_neighbours(40, 0, random), random_neighbours(60, 60, random),
          random_neighbours(200, 350, random), triangle_neighbours(15, random), star_neighbours(60, 5, random),
          star_neighbours(200, 12, random), tree_neighbours(150, random)}) {
        const EliminationOrdering elimination = order_elimination(neighbours);
        const SparsePattern upper = upper_in(neighbours, elimination.order);
        REQUIRE(elimination.tree.parent.size() == usize(neighbours.n()));
        std::vector<Index> places;
        const SymbolicFactor factor = make_symmetric_symbolic_factor(upper, 0, elimination.tree, places);
        std::vector<Index> as_they_are(upper.n());
        std::iota(as_they_are.begin(), as_they_are.end(), 0);
        const Eigen::MatrixXi expected = eliminated(upper, as_they_are);
        const Eigen::MatrixXi found = from_blocks(factor);
        CHECK((found.array() >= expected.array()).all());
        CHECK(found.sum() <= 2.5 * expected.sum());
        for (Index b = 0; b < factor.n_supernodes(); ++b)
            CHECK(std::is_sorted(factor.rows[b].begin(), factor.rows[b].end(), std::less_equal<>()));
        check_places(upper, factor, places);
    }
}

TEST_CASE("subtrees of the elimination tree are made one block where that takes few zeros")
{
    // Two leaves of one column each, below a third with which all later unknowns have to do.
    const SparsePattern upper = make_pattern(6, {{0, 0},
                                                 {1, 1},
                                                 {2, 0},
                                                 {2, 1},
                                                 {2, 2},
                                                 {3, 2},
                                                 {3, 3},
                                                 {4, 2},
                                                 {4, 3},
                                                 {4, 4},
                                                 {5, 2},
                                                 {5, 3},
                                                 {5, 4},
                                                 {5, 5}});
    std::vector<Index> places;
    const SymbolicFactor factor = make_symmetric_symbolic_factor(upper, 0, {}, places);
    CHECK(factor.first == std::vector<Index>{0, 6});
    check_places(upper, factor, places);

    // What leads to the third is not together: column 1 has nothing to do with it.
    const SparsePattern apart = make_pattern(
        7, {{0, 0}, {1, 1}, {2, 2}, {3, 0}, {3, 2}, {3, 3}, {4, 3}, {4, 4}, {5, 3}, {5, 4}, {5, 5}, {6, 1}, {6, 6}});
    const SymbolicFactor blocks = make_symmetric_symbolic_factor(apart, 0, {}, places);
    CHECK(blocks.first == std::vector<Index>{0, 1, 2, 6, 7});
    check_places(apart, blocks, places);
}

TEST_CASE("subtrees remain apart where one block of them would have many zeros, or be too wide")
{
    std::vector<Index> places;
    const auto full_from = [&](Index begin, Index n, std::vector<MatrixEntry> entries) {
        for (Index column = 0; column < n; ++column)
            for (Index row = 0; row <= column; ++row)
                if (row == column || row >= begin)
                    entries.push_back({column, row});
        const SparsePattern upper = make_pattern(n, entries);
        SymbolicFactor factor = make_symmetric_symbolic_factor(upper, 0, {}, places);
        check_places(upper, factor, places);
        return factor.first;
    };
    // Two leaves with one row each: a block with the others would have seven zeros, or more, for either of them.
    CHECK(full_from(2, 10, {{2, 0}, {2, 1}}) == std::vector<Index>{0, 1, 2, 10});
    // Two leaves that have all rows but each other's: one zero.
    const auto with_two_leaves = [&](Index n) {
        std::vector<MatrixEntry> entries;
        for (Index column = 2; column < n; ++column)
            entries.insert(entries.end(), {{column, 0}, {column, 1}});
        return full_from(2, n, entries);
    };
    CHECK(with_two_leaves(32) == std::vector<Index>{0, 32});
    CHECK(with_two_leaves(33) == std::vector<Index>{0, 1, 33});
}
