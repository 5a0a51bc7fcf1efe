#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/elimination_order.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("the order of elimination is a permutation with less fill-in than the rows' own order")
{
    RandomNumbers random(3);
    const SymmetricMatrix matrix = grid_matrix(20, 1.0, random);
    std::vector<Index> order = elimination_order(matrix.upper);
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
    std::vector<Index> order = elimination_order(matrix.upper, is_last);
    CHECK(std::is_sorted(order.begin(), order.end(),
                         [&](Index a, Index b) { return !is_last[at(a)] && is_last[at(b)]; }));
    std::sort(order.begin(), order.end());
    for (Index u = 0; u < matrix.upper.n(); ++u)
        CHECK(order[at(u)] == u);
    CHECK(elimination_order(SparsePattern{}).empty());
}

TEST_CASE("a single unknown that is asked to be last is the first as well")
{
    const SparsePattern one = make_pattern(1, {{0, 0}});
    for (int i = 0; i < 100; ++i)
        CHECK(elimination_order(one, {true}) == std::vector<Index>{0});
}
