#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/sparse/elimination_ordering.h"
#include "tests/support/random_graphs.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("the elimination ordering is a permutation with less fill-in than the rows' own order")
{
    RandomNumbers random(3);
    const SymmetricMatrix matrix = grid_matrix(20, 1.0, random);
    std::vector<Index> order = elimination_ordering(matrix.upper);
    const auto fill_in = [&](const std::vector<Index>& eliminated) {
        Eigen::MatrixXd filled = matrix.dense;
        for (std::size_t i = 0; i < eliminated.size(); ++i)
            for (std::size_t j = i + 1; j < eliminated.size(); ++j)
                for (std::size_t k = i + 1; k < eliminated.size(); ++k)
                    if (filled(eliminated[i], eliminated[j]) != 0.0 && filled(eliminated[i], eliminated[k]) != 0.0)
                        filled(eliminated[j], eliminated[k]) = 1.0;
        return (filled.array() != 0.0).count();
    };
    std::vector<Index> identity(order.size());
    for (std::size_t i = 0; i < identity.size(); ++i)
        identity[i] = static_cast<Index>(i);
    CHECK(fill_in(order) < fill_in(identity) / 2);
    std::sort(order.begin(), order.end());
    CHECK(order == identity);
}

TEST_CASE("unknowns that are asked to be last are the last")
{
    RandomNumbers random(4);
    const SymmetricMatrix matrix = grid_matrix(12, 1.0, random);
    std::vector<bool> is_last;
    for (Index u = 0; u < matrix.upper.n(); ++u)
        is_last.push_back(random.below(4) == 0);
    std::vector<Index> order = elimination_ordering(matrix.upper, is_last);
    CHECK(std::is_sorted(order.begin(), order.end(), [&](Index a, Index b) { return !is_last[a] && is_last[b]; }));
    std::sort(order.begin(), order.end());
    for (Index u = 0; u < matrix.upper.n(); ++u)
        CHECK(order[u] == u);
    CHECK(elimination_ordering(SparsePattern{}).empty());
}

TEST_CASE("a single unknown that is asked to be last is the first as well")
{
    const SparsePattern one = make_pattern(1, {{0, 0}});
    for (int i = 0; i < 100; ++i)
        CHECK(elimination_ordering(one, {true}) == std::vector<Index>{0});
}

TEST_CASE("the tree that comes with an order has the rows of the columns that end blocks, and leads past none of them")
{
    RandomNumbers random(5);
    for (const SparsePattern& neighbours :
         {random_neighbours(1, 0, random), random_neighbours(2, 3, random), random_neighbours(100, 150, random),
          random_neighbours(200, 600, random), triangle_neighbours(10, random), triangle_neighbours(25, random),
          star_neighbours(60, 5, random), star_neighbours(200, 12, random), tree_neighbours(150, random)}) {
        const Index n = neighbours.n();
        const auto [order, tree] = order_elimination(neighbours);
        std::vector<Index> sorted = order;
        std::sort(sorted.begin(), sorted.end());
        for (Index u = 0; u < n; ++u)
            CHECK(sorted[u] == u);

        const SparsePattern upper = upper_in(neighbours, order);
        std::vector<std::vector<bool>> filled(n, std::vector<bool>(n, false));
        for (Index column = 0; column < n; ++column)
            for (Index k = upper.column_offsets[column]; k < upper.column_offsets[column + 1]; ++k)
                filled[upper.rows[k]][column] = true;
        int n_ends = 0;
        for (Index column = 0; column < n; ++column) {
            std::vector<Index> rows;
            for (Index row = column + 1; row < n; ++row)
                if (filled[column][row])
                    rows.push_back(row);
            for (const Index a : rows)
                for (const Index b : rows)
                    filled[a][b] = true;
            const Index parent = tree.parent[column];
            const auto count = static_cast<Index>(rows.size());
            CHECK(tree.count[column] >= count);
            if (parent < 0 || parent != column + 1 || tree.count[parent] + 1 != tree.count[column]) {
                ++n_ends;
                CHECK((parent < 0) == rows.empty());
                CHECK(tree.count[column] == count);
            }
            for (const Index row : rows)
                CHECK(row >= parent);
        }
        CHECK(n_ends > n / 4);
    }
}

TEST_CASE("unknowns with very many neighbours are last, and the tree is not known")
{
    std::vector<MatrixEntry> entries;
    for (Index u = 1; u < 300; ++u)
        entries.insert(entries.end(), {{0, u}, {u, 0}});
    const auto [order, tree] = order_elimination(make_pattern(300, entries));
    CHECK(order.back() == 0);
    CHECK(tree.parent.empty());
    CHECK(tree.count.empty());
    CHECK(order_elimination(SparsePattern{}).order.empty());
}
