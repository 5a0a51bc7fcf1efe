#include <Eigen/LU>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/direct/direct_solver.h"
#include "solvers/direct/make_solver.h"
#include "tests/support/heap.h"
#include "tests/support/matrices.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

Columns solved(DirectSolver& solver, std::span<const double> values, const Columns& right_hand_side,
               SolverWorkspace& workspace)
{
    const auto factor = solver.factorise(values, heap(), workspace);
    REQUIRE(factor);
    Columns solution;
    factor->solve(right_hand_side, solution, workspace);
    return solution;
}

/// This factorisation, or the own one where a build has not that.
Factorisation foreign(Factorisation factorisation)
{
    return is_available(factorisation) ? factorisation : Factorisation::Own;
}

}  // namespace

TEST_CASE("three symmetric systems are solved at once, and matrices that are not positive definite refused")
{
    RandomNumbers random(1);
    SolverWorkspace workspace;
    const SymmetricMatrix matrix = grid_matrix(9, 0.5, random);
    auto indefinite = matrix.values;
    indefinite[matrix.upper.slot({30, 30})] = -1.0;
    const Columns right = random_columns(81, random);
    for (const Factorisation asked : {Factorisation::Automatic, Factorisation::Own, Factorisation::Cholmod}) {
        if (!is_available(asked))
            continue;
        CAPTURE(static_cast<int>(asked));
        const auto solver = make_symmetric_solver(matrix.upper, asked, workspace);
        CHECK(solver->kind() == (asked == Factorisation::Cholmod ? asked : Factorisation::Own));
        CHECK(solver->factor_bytes() > 0);
        CHECK_FALSE(solver->factorise(indefinite, heap(), workspace));
        CHECK((matrix.dense * solved(*solver, matrix.values, right, workspace) - right).norm() < 1e-12);
    }
}

TEST_CASE("a system without unknowns is solved by any factorisation")
{
    SolverWorkspace workspace;
    for (const Factorisation asked : {Factorisation::Automatic, foreign(Factorisation::Cholmod)})
        CHECK(solved(*make_symmetric_solver({}, asked, workspace), {}, Columns(0, 3), workspace).rows() == 0);
}

TEST_CASE("large symmetric systems are solved by CHOLMOD where it is there")
{
    RandomNumbers random(4);
    SolverWorkspace workspace;
    const Index n = 2'000'001;
    std::vector<MatrixEntry> entries;
    for (Index u = 0; u < n; ++u) {
        entries.push_back({u, u});
        if (u > 0)
            entries.push_back({u, u - 1});
    }
    const SparsePattern upper = make_pattern(n, entries);
    std::vector<double> values(upper.n_entries(), -1.0);
    for (Index u = 0; u < n; ++u)
        values[upper.slot({u, u})] = 2.5;
    const auto solver = make_symmetric_solver(upper, Factorisation::Automatic, workspace);
    CHECK(solver->kind() == foreign(Factorisation::Cholmod));
    const Columns right = random_columns(n, random);
    const Columns found = solved(*solver, values, right, workspace);
    Columns residual = 2.5 * found - right;
    residual.topRows(n - 1) -= found.bottomRows(n - 1);
    residual.bottomRows(n - 1) -= found.topRows(n - 1);
    CHECK(residual.cwiseAbs().maxCoeff() < 1e-14);
    values[upper.slot({7, 7})] = -1.0;
    CHECK_FALSE(solver->factorise(values, heap(), workspace));
}

TEST_CASE("matrices with and without a diagonal are solved by turns, singular ones refused")
{
    RandomNumbers random(1);
    SolverWorkspace workspace;
    const SparsePattern pattern = random_pattern(50, random);
    const auto made = make_general_solver(pattern, Factorisation::Own);
    DirectSolver& solver = *made;
    CHECK(solver.kind() == Factorisation::Own);
    for (int repetition = 0; repetition < 3; ++repetition) {
        const auto with_diagonal = random_values(pattern, random);
        auto without_diagonal = with_diagonal;
        for (Index i = 0; i < 50; i += 7)
            without_diagonal[pattern.slot({i, i})] = 0.0;
        const std::vector<double> singular(with_diagonal.size(), 0.0);
        CHECK_THROWS_AS(static_cast<void>(solver.factorise(singular, heap(), workspace)), ComputationError);
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
    const auto made = make_general_solver(pattern, Factorisation::Own);
    DirectSolver& solver = *made;
    CHECK(solver.kind() == Factorisation::Own);
    Columns right_hand_side(2, 3);
    right_hand_side << 1, 2, 3, 4, 5, 6;
    const Columns solution = solved(solver, std::vector<double>{0.0, 2.0, 4.0, 0.0}, right_hand_side, workspace);
    Columns expected(2, 3);
    expected << 2, 2.5, 3, 0.25, 0.5, 0.75;
    CHECK(solution == expected);
    CHECK(solver.kind() == (is_available(Factorisation::Umfpack) ? Factorisation::Umfpack : Factorisation::Eigen));
}

TEST_CASE("large general systems are solved, by UMFPACK where it is there and nothing else is asked for")
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
    const Columns right_hand_side = random_columns(n, random);
    for (const Factorisation asked : {Factorisation::Automatic, Factorisation::Own}) {
        const auto solver = make_general_solver(pattern, asked);
        CHECK(solver->kind() == (asked == Factorisation::Own ? asked : foreign(Factorisation::Umfpack)));
        const Columns solution = solved(*solver, values, right_hand_side, workspace);
        Columns residual = -right_hand_side;
        for (Index column = 0; column < n; ++column)
            for (Index k = pattern.column_offsets[column]; k < pattern.column_offsets[column + 1]; ++k)
                residual.row(pattern.rows[k]) += values[k] * solution.row(column);
        CHECK(residual.cwiseAbs().maxCoeff() < 1e-13);
    }
}

TEST_CASE("matrices that are nearly singular are found out, and those whose pivots merely grow are solved")
{
    SolverWorkspace workspace;
    const SparsePattern pattern = make_pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
    const auto made = make_general_solver(pattern, Factorisation::Automatic);
    DirectSolver& solver = *made;
    const Columns right_hand_side = Columns::Constant(2, 3, 2.0);
    const std::vector<double> nearly_singular{1.0, 1.0, 1.0, 1.0 + 1e-15};
    const Columns solution = solved(solver, nearly_singular, right_hand_side, workspace);
    CHECK(solver.factorise(nearly_singular, heap(), workspace)->is_nearly_singular());
    CHECK((dense(pattern, nearly_singular) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-14);
    const std::vector<double> regular{2.0, 1.0, 1.0, 2.0};
    CHECK_FALSE(solver.factorise(regular, heap(), workspace)->is_nearly_singular());

    const Index n = 14;
    const auto [full, growing] = growing_matrix(n);
    const auto careful = make_general_solver(full, Factorisation::Automatic);
    RandomNumbers random(6);
    const Columns of_full = random_columns(n, random);
    const Columns expected = dense(full, growing).fullPivLu().solve(of_full);
    CHECK((solved(*careful, growing, of_full, workspace) - expected).cwiseAbs().maxCoeff() < 1e-10);
    CHECK_FALSE(careful->factorise(growing, heap(), workspace)->is_nearly_singular());
}

TEST_CASE("whose factorisation a general system has is what was asked for, but where pivots are too small")
{
    RandomNumbers random(3);
    SolverWorkspace workspace;
    const SparsePattern pattern = random_pattern(40, random);
    const auto values = random_values(pattern, random);
    const Columns right = random_columns(40, random);
    const auto own = make_general_solver(pattern, Factorisation::Own);
    const Columns expected = solved(*own, values, right, workspace);
    CHECK(own->kind() == Factorisation::Own);
    for (const Factorisation asked : {Factorisation::Cholmod, Factorisation::Umfpack}) {
        if (!is_available(asked))
            continue;
        const auto solver = make_general_solver(pattern, asked);
        CHECK(solver->kind() == Factorisation::Umfpack);
        CHECK((solved(*solver, values, right, workspace) - expected).cwiseAbs().maxCoeff() < 1e-12);
    }
}
