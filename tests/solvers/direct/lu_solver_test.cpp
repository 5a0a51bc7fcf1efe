#include <cmath>
#include <initializer_list>
#include <vector>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/direct/lu_solver.h"
#include "tests/support/heap.h"
#include "tests/support/matrices.h"
#include "tests/support/random_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

Columns solved(const LuSolver& solver, std::span<const double> values, const Columns& right_hand_side,
               LuWorkspace& workspace)
{
    const auto factor = solver.factorise(values, heap(), workspace);
    REQUIRE(factor);
    Columns solution(right_hand_side.rows(), 3);
    factor->solve(right_hand_side, solution, workspace);
    return solution;
}

struct Entry {
    Index row;
    Index column;
    double value;
};

/// Whether the diagonal of a matrix will do whose first columns and rows have these entries. Rows and columns are
/// numbered in the elimination ordering; the rest of the matrix is the identity.
bool will_do(std::initializer_list<Entry> entries)
{
    constexpr Index n = 5;
    std::vector<MatrixEntry> all;
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
            all.push_back({i, j});
    const SparsePattern pattern = make_pattern(n, all);
    const std::vector<Index> position = make_symbolic_factor(pattern).position;
    std::vector<Index> unknown(n);
    for (Index v = 0; v < n; ++v)
        unknown[position.empty() ? v : position[v]] = v;
    std::vector<double> values(n * n, 0.0);
    for (Index v = 0; v < n; ++v)
        values[pattern.slot({v, v})] = 1.0;
    for (const auto& [row, column, value] : entries)
        values[pattern.slot({unknown[column], unknown[row]})] = value;
    LuWorkspace workspace;
    return LuSolver(pattern).factorise(values, heap(), workspace).has_value();
}

}  // namespace

TEST_CASE("three systems are solved at once, for one set of values after the other, with any workspace")
{
    RandomNumbers random(1);
    LuWorkspace workspace;
    for (const Index n : {1, 2, 3, 10, 150, 40}) {
        const SparsePattern pattern = random_pattern(n, random);
        LuSolver solver(pattern);
        for (int repetition = 0; repetition < 3; ++repetition) {
            const auto values = random_values(pattern, random);
            const Columns right_hand_side = random_columns(n, random);
            const Columns solution = solved(solver, values, right_hand_side, workspace);
            const Columns expected = dense(pattern, values).fullPivLu().solve(right_hand_side);
            CHECK((solution - expected).cwiseAbs().maxCoeff() < 1e-12);
            LuWorkspace another;
            CHECK(solved(solver, values, right_hand_side, another) == solution);
        }
    }
}

TEST_CASE("without any entries that are zero there is one block, solved like any other matrix")
{
    RandomNumbers random(2);
    LuWorkspace workspace;
    std::vector<MatrixEntry> entries;
    for (Index i = 0; i < 23; ++i)
        for (Index j = 0; j < 23; ++j)
            entries.push_back({i, j});
    const SparsePattern pattern = make_pattern(23, entries);
    auto values = random_values(pattern, random);
    for (Index i = 0; i < 23; ++i)
        values[pattern.slot({i, i})] += 20.0;
    LuSolver solver(pattern);
    const Columns right_hand_side = random_columns(23, random);
    const Columns expected = dense(pattern, values).fullPivLu().solve(right_hand_side);
    CHECK((solved(solver, values, right_hand_side, workspace) - expected).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("the size of a row does not matter")
{
    RandomNumbers random(3);
    LuWorkspace workspace;
    const SparsePattern pattern = random_pattern(60, random);
    auto values = random_values(pattern, random);
    Columns right_hand_side = random_columns(60, random);
    const Columns expected = dense(pattern, values).fullPivLu().solve(right_hand_side);
    for (std::size_t slot = 0; slot < values.size(); ++slot)
        if (pattern.rows[slot] % 3 == 0)
            values[slot] *= 1e9;
    for (Index row = 0; row < 60; row += 3)
        right_hand_side.row(row) *= 1e9;
    LuSolver solver(pattern);
    CHECK((solved(solver, values, right_hand_side, workspace) - expected).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a diagonal that will not do is found out, and the solver goes on with others")
{
    RandomNumbers random(4);
    LuWorkspace workspace;
    const SparsePattern pattern = random_pattern(40, random);
    LuSolver solver(pattern);
    const auto values = random_values(pattern, random);
    for (const double pivot : {0.0, 1e-5, -1e-5}) {
        auto without_pivot = values;
        for (Index i = 0; i < 40; ++i)
            without_pivot[pattern.slot({i, i})] = pivot;
        CHECK_FALSE(solver.factorise(without_pivot, heap(), workspace));
    }
    auto singular = values;
    for (Index i = pattern.column_offsets[12]; i < pattern.column_offsets[13]; ++i)
        singular[i] = 0.0;
    CHECK_FALSE(solver.factorise(singular, heap(), workspace));
    CHECK_FALSE(solver.factorise(std::vector<double>(values.size(), 0.0), heap(), workspace));
    const Columns right_hand_side = random_columns(40, random);
    const Columns expected = dense(pattern, values).fullPivLu().solve(right_hand_side);
    CHECK((solved(solver, values, right_hand_side, workspace) - expected).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("a pivot will not do that is much less than an entry below it, however little the others grow")
{
    // The rows' sizes are 1 and 2, about.
    const auto does = [](double multiplier) { return will_do({{0, 0, 1.0 / multiplier}, {0, 1, 1.0}, {1, 0, 1.0}}); };
    for (const double sign : {1.0, -1.0}) {
        for (const double multiplier : {2.0, 100.0, 1900.0})
            CHECK(does(sign * multiplier));
        for (const double multiplier : {2100.0, 1e4, 1e5})
            CHECK_FALSE(does(sign * multiplier));
    }
}

TEST_CASE("pivots will not do that let an entry grow a million times, however little each of them does")
{
    // What stands in the last column is multiplied in every row but the last. The fourth row's size is 2.
    const auto does = [](double multiplier) {
        const double pivot = 1.0 / multiplier;
        return will_do(
            {{0, 0, pivot}, {0, 4, 1.0}, {1, 0, -1.0}, {1, 1, pivot}, {2, 1, -1.0}, {2, 2, pivot}, {3, 2, -1.0}});
    };
    for (const double growth : {1e4, 1e6, 1.9e6})
        CHECK(does(std::cbrt(growth)));
    for (const double growth : {2.1e6, 1e7, 1e8})
        for (const double sign : {1.0, -1.0})
            CHECK_FALSE(does(sign * std::cbrt(growth)));
}

TEST_CASE("a pivot will not do that is next to nothing, though nothing stands below it")
{
    // The row's size is 2.
    const auto does = [](double pivot) { return will_do({{0, 1, 1.0}, {1, 0, 1.0}, {1, 1, 1.0 + pivot}}); };
    for (const double pivot : {1e-6, 2.2e-12, -2.2e-12})
        CHECK(does(pivot));
    for (const double pivot : {1.8e-12, -1.8e-12, 1e-15, 0.0})
        CHECK_FALSE(does(pivot));
}
