#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/direct/foreign_solvers.h"
#include "tests/support/heap.h"
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

using MakeLu = std::unique_ptr<DirectSolver>(const SparsePattern&);

/// Eigen's L U, and UMFPACK's where that is there.
std::vector<MakeLu*> foreign_lu()
{
    std::vector<MakeLu*> list{&make_eigen_lu};
    if (is_available(Factorisation::Umfpack))
        list.push_back(&make_umfpack_lu);
    return list;
}

/// Neither wants anything from others.
DirectSolver::Factor factorised(DirectSolver& solver, std::span<const double> values)
{
    SolverWorkspace workspace;
    return *solver.factorise(values, heap(), workspace);
}

Columns solved(const DirectSolver::Factor& factor, const Columns& right_hand_side)
{
    SolverWorkspace workspace;
    Columns solution;
    factor.solve(right_hand_side, solution, workspace);
    return solution;
}

Columns solved(DirectSolver& solver, std::span<const double> values, const Columns& right_hand_side)
{
    return solved(factorised(solver, values), right_hand_side);
}

}  // namespace

TEST_CASE("random systems are solved, one set of values after the other")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        RandomNumbers random(1);
        for (const Index n : {1, 2, 10, 150}) {
            const SparsePattern pattern = random_pattern(n, random);
            const auto solver = make(pattern);
            for (int repetition = 0; repetition < 3; ++repetition) {
                const auto values = random_values(pattern, random);
                const Columns right_hand_side = random_columns(n, random);
                const Columns solution = solved(*solver, values, right_hand_side);
                const Eigen::MatrixXd A = dense(pattern, values);
                CHECK((A * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-10);
                CHECK((A.fullPivLu().solve(right_hand_side) - solution).cwiseAbs().maxCoeff() < 1e-10);
            }
        }
    }
}

TEST_CASE("singular matrices are refused, and the solver goes on with regular ones")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        RandomNumbers random(3);
        const SparsePattern pattern = random_pattern(30, random);
        const auto regular = random_values(pattern, random);
        auto singular = regular;
        for (Index i = pattern.column_offsets[12]; i < pattern.column_offsets[13]; ++i)
            singular[i] = 0.0;
        const auto solver = make(pattern);
        CHECK_THROWS_WITH_AS(static_cast<void>(factorised(*solver, singular)),
                             doctest::Contains("the system is singular"), ComputationError);
        CHECK_THROWS_AS(static_cast<void>(factorised(*solver, std::vector<double>(regular.size(), 0.0))),
                        ComputationError);
        const Columns right_hand_side = random_columns(30, random);
        const Columns solution = solved(*solver, regular, right_hand_side);
        CHECK((dense(pattern, regular) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-10);
    }
}

TEST_CASE("a column without entries makes a matrix singular")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        const SparsePattern pattern = make_pattern(3, {{0, 0}, {1, 1}, {0, 2}});
        const std::vector<double> values{1.0, 1.0, 1.0};
        CHECK_THROWS_AS(static_cast<void>(factorised(*make(pattern), values)), ComputationError);
    }
}

TEST_CASE("large systems, solved with long integers, agree with small ones")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
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
        const Columns expected = solved(*make(block), block_values, block_right_hand_side);

        const SparsePattern pattern = repeated(block, copies);
        std::vector<double> values;
        for (Index k = 0; k < copies; ++k)
            values.insert(values.end(), block_values.begin(), block_values.end());
        const Columns right_hand_side = block_right_hand_side.replicate(copies, 1);
        const Columns solution = solved(*make(pattern), values, right_hand_side);
        CHECK((solution - expected.replicate(copies, 1)).cwiseAbs().maxCoeff() < 1e-12);
    }
}

TEST_CASE("where pivots on the diagonal would lose all digits, larger ones are found")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        const Index n = 14;
        const auto [pattern, values] = growing_matrix(n);
        RandomNumbers random(5);
        const Columns right_hand_side = random_columns(n, random);
        const auto solver = make(pattern);
        const auto factor = factorised(*solver, values);
        CHECK_FALSE(factor.is_nearly_singular());
        const Columns solution = solved(factor, right_hand_side);
        CHECK((dense(pattern, values).fullPivLu().solve(right_hand_side) - solution).cwiseAbs().maxCoeff() < 1e-10);
    }
}

TEST_CASE("where the largest pivots lose digits as well, refinement brings them back")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        const Index n = 50;
        const auto [pattern, values] = doubling_matrix(n);
        RandomNumbers random(6);
        const Columns right_hand_side = random_columns(n, random);
        const Columns solution = solved(*make(pattern), values, right_hand_side);
        CHECK((dense(pattern, values).fullPivLu().solve(right_hand_side) - solution).cwiseAbs().maxCoeff() < 1e-12);
    }
}

TEST_CASE("nearly singular matrices are solved as well as that goes, and said to be what they are")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        const SparsePattern pattern = make_pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
        const auto solver = make(pattern);
        const std::vector<double> nearly_singular{1.0, 1.0, 1.0, 1.0 + 1e-15};
        const std::vector<double> regular{1.0, 1.0, 1.0, 1.0 + 1e-9};
        const auto is_nearly_singular = [&](const std::vector<double>& values) {
            return factorised(*solver, values).is_nearly_singular();
        };
        CHECK_FALSE(is_nearly_singular(regular));
        CHECK(is_nearly_singular(nearly_singular));
        const Columns right_hand_side = Columns::Constant(2, 3, 2.0);
        const Columns solution = solved(*solver, nearly_singular, right_hand_side);
        CHECK((dense(pattern, nearly_singular) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-14);
        CHECK_FALSE(is_nearly_singular(regular));
    }
}

TEST_CASE("one pivot that is next to nothing is enough, wherever it is")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        const SparsePattern block = make_pattern(2, {{0, 0}, {0, 1}, {1, 0}, {1, 1}});
        const SparsePattern pattern = repeated(block, 3);
        const auto solver = make(pattern);
        for (std::size_t place = 0; place < 3; ++place) {
            CAPTURE(place);
            std::vector<double> values{2.0, 1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 2.0};
            CHECK_FALSE(factorised(*solver, values).is_nearly_singular());
            std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(4 * place), 3, 1.0);
            values[4 * place + 3] = 1.0 + 1e-15;
            CHECK(factorised(*solver, values).is_nearly_singular());
        }
    }
}

TEST_CASE("equations in any units have the same solution, and are no more singular")
{
    for (MakeLu* const make : foreign_lu()) {
        CAPTURE(make == &make_eigen_lu);
        RandomNumbers random(7);
        const Index n = 40;
        const SparsePattern pattern = random_pattern(n, random);
        const auto values = random_values(pattern, random);
        const Columns right_hand_side = random_columns(n, random);
        auto in_units = values;
        Columns right_hand_side_in_units = right_hand_side;
        const auto unit = [](Index row) { return std::ldexp(1.0, 7 * (row % 20)); };
        for (std::size_t i = 0; i < values.size(); ++i)
            in_units[i] *= unit(pattern.rows[i]);
        for (Index row = 0; row < n; ++row)
            right_hand_side_in_units.row(row) *= unit(row);
        const auto solver = make(pattern);
        const auto factor = factorised(*solver, in_units);
        CHECK_FALSE(factor.is_nearly_singular());
        const Columns solution = solved(factor, right_hand_side_in_units);
        CHECK((dense(pattern, values) * solution - right_hand_side).cwiseAbs().maxCoeff() < 1e-12);
    }
}
