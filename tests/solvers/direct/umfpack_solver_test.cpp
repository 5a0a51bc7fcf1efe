#include <cmath>
#include <utility>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/direct/umfpack_solver.h"
#include "tests/support/matrices.h"
#include "tests/support/random_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// `copies` times the same matrix along the diagonal.
SparsePattern repeated(const SparsePattern& block, Index copies)
{
    std::vector<MatrixEntry> entries;
    for (Index k = 0; k < copies; ++k)
        for (Index column = 0; column < block.n(); ++column)
            for (Index i = block.column_offsets[column]; i < block.column_offsets[column + 1]; ++i)
                entries.push_back({k * block.n() + column, k * block.n() + block.rows[i]});
    return make_pattern(copies * block.n(), entries);
}

/// Wilkinson's matrix: entries double with every pivot, although no entry is larger than its pivot.
GrowingMatrix doubling_matrix(Index n)
{
    GrowingMatrix matrix = growing_matrix(n);
    for (Index column = 0; column < n; ++column)
        for (Index row = 0; row < n; ++row)
            matrix.values[matrix.pattern.slot({column, row})] = row == column || column == n - 1 ? 1.0
                                                                : row > column                   ? -1.0
                                                                                                 : 0.0;
    return matrix;
}

}  // namespace

TEST_CASE("random systems are solved, one set of values after the other")
{
    RandomNumbers random(1);
    for (const Index n : {1, 2, 10, 150}) {
        const SparsePattern pattern = random_pattern(n, random);
        UmfpackSolver solver(pattern);
        for (int repetition = 0; repetition < 3; ++repetition) {
            const auto values = random_values(pattern, random);
            const Columns right_hand_side = random_columns(n, random);
            Columns solution(n, 3);
            solver.factorise(values);
            solver.solve(values, right_hand_side, solution);
            const Eigen::MatrixXd A = dense(pattern, values);
            CHECK((A * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-10);
            CHECK((A.fullPivLu().solve(right_hand_side) - solution).cwiseAbs().maxCoeff() < 1e-10);
        }
    }
}

TEST_CASE("a factor may be replaced before it is used, and a solver moved")
{
    RandomNumbers random(2);
    const SparsePattern pattern = random_pattern(50, random);
    const auto unused = random_values(pattern, random);
    const auto values = random_values(pattern, random);
    const Columns right_hand_side = random_columns(50, random);
    Columns solution(50, 3);
    UmfpackSolver first(pattern);
    first.factorise(unused);
    first.factorise(values);
    UmfpackSolver second(std::move(first));
    second.solve(values, right_hand_side, solution);
    CHECK((dense(pattern, values) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("singular matrices are refused, and the solver goes on with regular ones")
{
    RandomNumbers random(3);
    const SparsePattern pattern = random_pattern(30, random);
    const auto regular = random_values(pattern, random);
    auto singular = regular;
    for (Index i = pattern.column_offsets[12]; i < pattern.column_offsets[13]; ++i)
        singular[i] = 0.0;
    UmfpackSolver solver(pattern);
    CHECK_THROWS_WITH_AS(solver.factorise(singular), doctest::Contains("the system is singular"), ComputationError);
    CHECK_THROWS_AS(solver.factorise(std::vector<double>(regular.size(), 0.0)), ComputationError);
    const Columns right_hand_side = random_columns(30, random);
    Columns solution(30, 3);
    solver.factorise(regular);
    solver.solve(regular, right_hand_side, solution);
    CHECK((dense(pattern, regular) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("a column without entries makes a matrix singular")
{
    const SparsePattern pattern = make_pattern(3, {{0, 0}, {1, 1}, {0, 2}});
    const std::vector<double> values{1.0, 1.0, 1.0};
    CHECK_THROWS_AS(UmfpackSolver(pattern).factorise(values), ComputationError);
}

TEST_CASE("large systems, solved with long integers, agree with small ones")
{
    RandomNumbers random(4);
    const Index n = 500;
    const Index copies = 201;
    const SparsePattern block = make_pattern(n, [&] {
        std::vector<MatrixEntry> entries;
        for (Index i = 0; i < n; ++i)
            for (const Index j : {i, (i + 1) % n, (i + 7) % n})
                entries.insert(entries.end(), {{i, j}, {j, i}});
        return entries;
    }());
    const auto block_values = random_values(block, random);
    const Columns block_right_hand_side = random_columns(n, random);
    Columns expected(n, 3);
    UmfpackSolver small(block);
    small.factorise(block_values);
    small.solve(block_values, block_right_hand_side, expected);

    const SparsePattern pattern = repeated(block, copies);
    std::vector<double> values;
    for (Index k = 0; k < copies; ++k)
        values.insert(values.end(), block_values.begin(), block_values.end());
    const Columns right_hand_side = block_right_hand_side.replicate(copies, 1);
    Columns solution(copies * n, 3);
    UmfpackSolver large(pattern);
    large.factorise(values);
    large.solve(values, right_hand_side, solution);
    CHECK((solution - expected.replicate(copies, 1)).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("where pivots on the diagonal would lose all digits, larger ones are found")
{
    const Index n = 14;
    const auto [pattern, values] = growing_matrix(n);
    RandomNumbers random(5);
    const Columns right_hand_side = random_columns(n, random);
    Columns solution(n, 3);
    UmfpackSolver solver(pattern);
    solver.factorise(values);
    CHECK_FALSE(solver.is_nearly_singular());
    solver.solve(values, right_hand_side, solution);
    CHECK((dense(pattern, values).fullPivLu().solve(right_hand_side) - solution).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("where the largest pivots lose digits as well, refinement brings them back")
{
    const Index n = 50;
    const auto [pattern, values] = doubling_matrix(n);
    RandomNumbers random(6);
    const Columns right_hand_side = random_columns(n, random);
    Columns solution(n, 3);
    UmfpackSolver solver(pattern);
    solver.factorise(values);
    solver.solve(values, right_hand_side, solution);
    CHECK((dense(pattern, values).fullPivLu().solve(right_hand_side) - solution).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("nearly singular matrices are solved as well as that goes, and said to be what they are")
{
    const SparsePattern pattern = make_pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
    UmfpackSolver solver(pattern);
    const std::vector<double> nearly_singular{1.0, 1.0, 1.0, 1.0 + 1e-15};
    const std::vector<double> regular{1.0, 1.0, 1.0, 1.0 + 1e-9};
    solver.factorise(regular);
    CHECK_FALSE(solver.is_nearly_singular());
    solver.factorise(nearly_singular);
    CHECK(solver.is_nearly_singular());
    Columns right_hand_side = Columns::Constant(2, 3, 2.0);
    Columns solution(2, 3);
    solver.solve(nearly_singular, right_hand_side, solution);
    CHECK((dense(pattern, nearly_singular) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-14);
    solver.factorise(regular);
    CHECK_FALSE(solver.is_nearly_singular());
}
