#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/lu_solver.h"
#include "tests/support/matrices.h"
#include "tests/support/random_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

Columns solved(LuSolver& solver, std::span<const double> values, const Columns& right_hand_side, LuWorkspace& workspace)
{
    REQUIRE(solver.factorise(values, heap_memory(), workspace));
    Columns solution(right_hand_side.rows(), 3);
    solver.solve(right_hand_side, solution, workspace);
    solver.free_factor(heap_memory());
    return solution;
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
            CHECK_FALSE(solver.has_factor());
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
        values[at(pattern.slot({i, i}))] += 20.0;
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
            without_pivot[at(pattern.slot({i, i}))] = pivot;
        CHECK_FALSE(solver.factorise(without_pivot, heap_memory(), workspace));
        CHECK_FALSE(solver.has_factor());
    }
    auto singular = values;
    for (Index i = pattern.column_offsets[12]; i < pattern.column_offsets[13]; ++i)
        singular[at(i)] = 0.0;
    CHECK_FALSE(solver.factorise(singular, heap_memory(), workspace));
    CHECK_FALSE(solver.factorise(std::vector<double>(values.size(), 0.0), heap_memory(), workspace));
    const Columns right_hand_side = random_columns(40, random);
    const Columns expected = dense(pattern, values).fullPivLu().solve(right_hand_side);
    CHECK((solved(solver, values, right_hand_side, workspace) - expected).cwiseAbs().maxCoeff() < 1e-12);
}
