#include <doctest/doctest.h>

#include "solvers/symmetric_solver.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("three systems are solved at once, and matrices that are not positive definite refused")
{
    RandomNumbers random(1);
    SolverWorkspace workspace;
    const SymmetricMatrix matrix = grid_matrix(9, 0.5, random);
    SymmetricSolver solver(matrix.upper, workspace);
    auto indefinite = matrix.values;
    indefinite[at(matrix.upper.slot({30, 30}))] = -1.0;
    CHECK_FALSE(solver.factorise(indefinite, workspace));
    REQUIRE(solver.factorise(matrix.values, workspace));
    Columns right = random_columns(81, random);
    Columns found;
    solver.solve(right, found, workspace);
    CHECK((matrix.dense * found - right).norm() < 1e-12);
    solver.free_factor(*workspace.factors);
}

TEST_CASE("so are large ones")
{
    RandomNumbers random(4);
    SolverWorkspace workspace;
    const Index n = 600'000;
    std::vector<MatrixEntry> entries;
    for (Index u = 0; u < n; ++u) {
        entries.push_back({u, u});
        if (u > 0)
            entries.push_back({u, u - 1});
    }
    const SparsePattern upper = make_pattern(n, entries);
    std::vector<double> values(at(upper.n_entries()), -1.0);
    for (Index u = 0; u < n; ++u)
        values[at(upper.slot({u, u}))] = 2.5;
    SymmetricSolver solver(upper, workspace);
    REQUIRE(solver.factorise(values, workspace));
    Columns right = random_columns(n, random);
    Columns found;
    solver.solve(right, found, workspace);
    Columns residual = 2.5 * found - right;
    residual.topRows(n - 1) -= found.bottomRows(n - 1);
    residual.bottomRows(n - 1) -= found.topRows(n - 1);
    CHECK(residual.cwiseAbs().maxCoeff() < 1e-14);
    values[at(upper.slot({7, 7}))] = -1.0;
    CHECK_FALSE(solver.factorise(values, workspace));
}
