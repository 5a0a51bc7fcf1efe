#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/cholmod_solver.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("three systems are solved at once, for one set of values after the other, with any workspace")
{
    RandomNumbers random(1);
    CholmodWorkspace workspace;
    CholmodWorkspace another;
    for (const Index side : {1, 2, 9, 20}) {
        const SymmetricMatrix first = grid_matrix(side, 1.0, random);
        CholmodSolver solver(first.upper, workspace);
        for (const double shift : {0.01, 1.0, 100.0}) {
            const SymmetricMatrix matrix = grid_matrix(side, shift, random);
            Columns right = random_columns(side * side, random);
            REQUIRE(solver.factorise(matrix.values, workspace));
            const Columns found = solver.solve(right, another);
            CHECK((matrix.dense * found - right).norm() < 1e-11 * matrix.dense.norm());
            CHECK(Columns(solver.solve(right, workspace)) == found);
            solver.free_factor();
        }
    }
}

TEST_CASE("a matrix that is not positive definite is found out, and the solver goes on with others")
{
    RandomNumbers random(2);
    CholmodWorkspace workspace;
    SymmetricMatrix matrix = grid_matrix(8, 0.1, random);
    CholmodSolver solver(matrix.upper, workspace);
    auto indefinite = matrix.values;
    indefinite[at(matrix.upper.slot({30, 30}))] = -1.0;
    CHECK_FALSE(solver.factorise(indefinite, workspace));
    auto singular = matrix.values;
    std::fill(singular.begin(), singular.end(), 0.0);
    CHECK_FALSE(solver.factorise(singular, workspace));
    Columns right = random_columns(64, random);
    REQUIRE(solver.factorise(matrix.values, workspace));
    CHECK((matrix.dense * Columns(solver.solve(right, workspace)) - right).norm() < 1e-10);
}

TEST_CASE("the order of elimination is a permutation with less fill-in than the rows' own order")
{
    RandomNumbers random(3);
    CholmodWorkspace workspace;
    const SymmetricMatrix matrix = grid_matrix(20, 1.0, random);
    std::vector<Index> order = elimination_order(matrix.upper, workspace);
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
