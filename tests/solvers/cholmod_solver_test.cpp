#include <algorithm>
#include <vector>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/cholmod_solver.h"
#include "tests/support/random_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

struct SymmetricMatrix {
    SparsePattern upper;
    std::vector<double> values;
    Eigen::MatrixXd dense;
};

/// A grid's Laplacian plus `shift` on the diagonal, with random weights.
SymmetricMatrix grid_matrix(Index side, double shift, RandomNumbers& random)
{
    const Index n = side * side;
    SymmetricMatrix matrix;
    matrix.dense = shift * Eigen::MatrixXd::Identity(n, n);
    std::vector<MatrixEntry> entries;
    const auto add_edge = [&](Index a, Index b) {
        const double weight = 1.5 + random.symmetric();
        entries.push_back({std::max(a, b), std::min(a, b)});
        matrix.dense(a, b) -= weight;
        matrix.dense(b, a) -= weight;
        matrix.dense(a, a) += weight;
        matrix.dense(b, b) += weight;
    };
    for (Index y = 0; y < side; ++y)
        for (Index x = 0; x < side; ++x) {
            entries.push_back({y * side + x, y * side + x});
            if (x + 1 < side)
                add_edge(y * side + x, y * side + x + 1);
            if (y + 1 < side)
                add_edge(y * side + x, (y + 1) * side + x);
        }
    matrix.upper = make_pattern(n, entries);
    for (Index column = 0; column < n; ++column)
        for (Index k = matrix.upper.column_offsets[at(column)]; k < matrix.upper.column_offsets[at(column) + 1]; ++k)
            matrix.values.push_back(matrix.dense(matrix.upper.rows[at(k)], column));
    return matrix;
}

}  // namespace

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
            REQUIRE(solver.factorise(matrix.values, heap_memory(), workspace));
            const Columns found = solver.solve(right, another);
            CHECK((matrix.dense * found - right).norm() < 1e-11 * matrix.dense.norm());
            CHECK(Columns(solver.solve(right, workspace)) == found);
            solver.free_factor(heap_memory());
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
    CHECK_FALSE(solver.factorise(indefinite, heap_memory(), workspace));
    auto singular = matrix.values;
    std::fill(singular.begin(), singular.end(), 0.0);
    CHECK_FALSE(solver.factorise(singular, heap_memory(), workspace));
    Columns right = random_columns(64, random);
    REQUIRE(solver.factorise(matrix.values, heap_memory(), workspace));
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

TEST_CASE("large systems are solved by dense blocks")
{
    RandomNumbers random(4);
    CholmodWorkspace workspace;
    const Index n = 60'000;
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
    CholmodSolver solver(upper, workspace);
    REQUIRE(solver.factorise(values, heap_memory(), workspace));
    Columns right = random_columns(n, random);
    const Columns found = solver.solve(right, workspace);
    Columns residual = 2.5 * found - right;
    residual.topRows(n - 1) -= found.bottomRows(n - 1);
    residual.bottomRows(n - 1) -= found.topRows(n - 1);
    CHECK(residual.cwiseAbs().maxCoeff() < 1e-14);
    values[at(upper.slot({7, 7}))] = -1.0;
    CHECK_FALSE(solver.factorise(values, heap_memory(), workspace));
}
