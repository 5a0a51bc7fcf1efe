#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/direct/cholmod_solver.h"
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
    indefinite[matrix.upper.slot({30, 30})] = -1.0;
    CHECK_FALSE(solver.factorise(indefinite, workspace));
    auto singular = matrix.values;
    std::fill(singular.begin(), singular.end(), 0.0);
    CHECK_FALSE(solver.factorise(singular, workspace));
    Columns right = random_columns(64, random);
    REQUIRE(solver.factorise(matrix.values, workspace));
    CHECK((matrix.dense * Columns(solver.solve(right, workspace)) - right).norm() < 1e-10);
}
