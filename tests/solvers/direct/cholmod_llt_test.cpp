#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/direct/foreign_solvers.h"
#include "tests/support/heap.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

std::optional<DirectSolver::Factor> factorised(DirectSolver& solver, std::span<const double> values,
                                               SolverWorkspace& workspace)
{
    return solver.factorise(values, heap(), workspace);
}

}  // namespace

TEST_CASE("three systems are solved at once, for one set of values after the other, with any workspace")
{
    RandomNumbers random(1);
    SolverWorkspace workspace;
    SolverWorkspace another;
    for (const Index side : {1, 2, 9, 20}) {
        const SymmetricMatrix first = grid_matrix(side, 1.0, random);
        const auto solver = make_cholmod_llt(first.upper, workspace.cholmod);
        for (const double shift : {0.01, 1.0, 100.0}) {
            const SymmetricMatrix matrix = grid_matrix(side, shift, random);
            Columns right = random_columns(side * side, random);
            const auto factor = factorised(*solver, matrix.values, workspace);
            REQUIRE(factor);
            Columns found;
            factor->solve(right, found, another);
            CHECK((matrix.dense * found - right).norm() < 1e-11 * matrix.dense.norm());
            Columns again;
            factor->solve(right, again, workspace);
            CHECK(again == found);
        }
    }
}

TEST_CASE("a matrix that is not positive definite is found out, and the solver goes on with others")
{
    RandomNumbers random(2);
    SolverWorkspace workspace;
    SymmetricMatrix matrix = grid_matrix(8, 0.1, random);
    const auto solver = make_cholmod_llt(matrix.upper, workspace.cholmod);
    auto indefinite = matrix.values;
    indefinite[matrix.upper.slot({30, 30})] = -1.0;
    CHECK_FALSE(factorised(*solver, indefinite, workspace));
    auto singular = matrix.values;
    std::fill(singular.begin(), singular.end(), 0.0);
    CHECK_FALSE(factorised(*solver, singular, workspace));
    Columns right = random_columns(64, random);
    const auto factor = factorised(*solver, matrix.values, workspace);
    REQUIRE(factor);
    Columns found;
    factor->solve(right, found, workspace);
    CHECK((matrix.dense * found - right).norm() < 1e-10);
}
