#include <Eigen/LU>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/unsymmetric_solver.h"
#include "tests/support/matrices.h"
#include "tests/support/random_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

Columns solved(UnsymmetricSolver& solver, std::span<const double> values, const Columns& right_hand_side,
               SolverWorkspace& workspace)
{
    solver.factorise(values, workspace);
    Columns solution(right_hand_side.rows(), 3);
    solver.solve(values, right_hand_side, solution, workspace);
    solver.free_factor(*workspace.factors);
    return solution;
}

}  // namespace

TEST_CASE("matrices with and without a diagonal are solved by turns, singular ones refused")
{
    RandomNumbers random(1);
    SolverWorkspace workspace;
    const SparsePattern pattern = random_pattern(50, random);
    UnsymmetricSolver solver(pattern);
    for (int repetition = 0; repetition < 3; ++repetition) {
        const auto with_diagonal = random_values(pattern, random);
        auto without_diagonal = with_diagonal;
        for (Index i = 0; i < 50; i += 7)
            without_diagonal[at(pattern.slot({i, i}))] = 0.0;
        CHECK_THROWS_AS(solver.factorise(std::vector<double>(with_diagonal.size(), 0.0), workspace), ComputationError);
        for (const auto& values : {with_diagonal, without_diagonal}) {
            const Columns right_hand_side = random_columns(50, random);
            const Columns solution = solved(solver, values, right_hand_side, workspace);
            CHECK((dense(pattern, values) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-10);
        }
    }
}

TEST_CASE("a matrix without any diagonal is solved")
{
    SolverWorkspace workspace;
    const SparsePattern pattern = make_pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
    UnsymmetricSolver solver(pattern);
    Columns right_hand_side(2, 3);
    right_hand_side << 1, 2, 3, 4, 5, 6;
    const Columns solution = solved(solver, std::vector<double>{0.0, 2.0, 4.0, 0.0}, right_hand_side, workspace);
    Columns expected(2, 3);
    expected << 2, 2.5, 3, 0.25, 0.5, 0.75;
    CHECK(solution == expected);
}

TEST_CASE("large systems are solved too")
{
    RandomNumbers random(2);
    SolverWorkspace workspace;
    const Index n = 30'000;
    std::vector<MatrixEntry> entries;
    for (Index i = 0; i < n; ++i)
        for (const Index j : {i, (i + 1) % n})
            entries.push_back({i, j});
    const SparsePattern pattern = make_pattern(n, entries);
    const auto values = random_values(pattern, random);
    UnsymmetricSolver solver(pattern);
    const Columns right_hand_side = random_columns(n, random);
    const Columns solution = solved(solver, values, right_hand_side, workspace);
    Columns residual = -right_hand_side;
    for (Index column = 0; column < n; ++column)
        for (Index k = pattern.column_offsets[at(column)]; k < pattern.column_offsets[at(column) + 1]; ++k)
            residual.row(pattern.rows[at(k)]) += values[at(k)] * solution.row(column);
    CHECK(residual.cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("matrices that are nearly singular are found out, and those whose pivots merely grow are solved")
{
    SolverWorkspace workspace;
    const SparsePattern pattern = make_pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
    UnsymmetricSolver solver(pattern);
    const Columns right_hand_side = Columns::Constant(2, 3, 2.0);
    const std::vector<double> nearly_singular{1.0, 1.0, 1.0, 1.0 + 1e-15};
    const Columns solution = solved(solver, nearly_singular, right_hand_side, workspace);
    CHECK(solver.is_nearly_singular());
    CHECK((dense(pattern, nearly_singular) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-14);
    solved(solver, std::vector<double>{2.0, 1.0, 1.0, 2.0}, right_hand_side, workspace);
    CHECK_FALSE(solver.is_nearly_singular());

    const Index n = 14;
    const auto [full, growing] = growing_matrix(n);
    UnsymmetricSolver careful(full);
    RandomNumbers random(6);
    const Columns of_full = random_columns(n, random);
    const Columns expected = dense(full, growing).fullPivLu().solve(of_full);
    CHECK((solved(careful, growing, of_full, workspace) - expected).cwiseAbs().maxCoeff() < 1e-10);
    CHECK_FALSE(careful.is_nearly_singular());
}
