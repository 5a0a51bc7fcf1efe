#include <array>
#include <limits>
#include <thread>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include "solvers/direct/ldl_solver.h"
#include "tests/support/allocations.h"
#include "tests/support/backwards.h"
#include "tests/support/heap.h"
#include "tests/support/random_graphs.h"
#include "tests/support/symmetric_matrices.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// A matrix without any entries that are zero.
SymmetricMatrix full_matrix(Index n, RandomNumbers& random)
{
    SymmetricMatrix matrix;
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.symmetric(); });
    matrix.dense = root * root.transpose() + Eigen::MatrixXd::Identity(n, n);
    std::vector<MatrixEntry> entries;
    for (Index column = 0; column < n; ++column)
        for (Index row = 0; row <= column; ++row) {
            entries.push_back({column, row});
            matrix.values.push_back(matrix.dense(row, column));
        }
    matrix.upper = make_pattern(n, entries);
    return matrix;
}

/// Of the last unknowns all have to do with each other, and the others with any of them.
SymmetricMatrix arrow_matrix(Index n_first, Index n_last, RandomNumbers& random)
{
    SymmetricMatrix matrix;
    const Index n = n_first + n_last;
    matrix.dense = 2.0 * n * Eigen::MatrixXd::Identity(n, n);
    for (Index column = 0; column < n; ++column)
        for (Index row = 0; row < column; ++row)
            if (row >= n_first || (column >= n_first && random.below(3) > 0))
                matrix.dense(row, column) = matrix.dense(column, row) = random.symmetric();
    std::vector<MatrixEntry> entries;
    for (Index column = 0; column < n; ++column)
        for (Index row = 0; row <= column; ++row)
            if (matrix.dense(row, column) != 0.0) {
                entries.push_back({column, row});
                matrix.values.push_back(matrix.dense(row, column));
            }
    matrix.upper = make_pattern(n, entries);
    return matrix;
}

template <class Number = double>
Columns solved(const LdlSolver& solver, std::span<const double> values, const Columns& right, LdlWorkspace& workspace)
{
    auto factor = solver.factorise<Number>(values, heap(), workspace);
    REQUIRE(factor);
    Columns solution;
    factor->solve(right, solution, workspace);
    return solution;
}

/// L D Lᵀ multiplied out.
template <class Number>
Eigen::MatrixXd product(const DenseLdl<Number>& factor)
{
    const Eigen::MatrixXd numbers = factor.template cast<double>();
    const Eigen::MatrixXd L = numbers.triangularView<Eigen::UnitLower>();
    return L * numbers.diagonal().asDiagonal() * L.transpose();
}

/// The right-hand sides or solutions that a factor has.
template <class Number>
auto rows_of(LdlFactor<Number>& factor, Index n)
{
    return Eigen::Map<Eigen::Matrix<Number, Eigen::Dynamic, ldl_row, Eigen::RowMajor>>(factor.rows(), n, ldl_row);
}

/// Triangles in the elimination ordering, enough of them for several threads: weak couplings, and a diagonal that
/// outweighs them.
struct OrderedTriangles {
    explicit OrderedTriangles(RandomNumbers& random)
    {
        const SparsePattern neighbours = triangle_neighbours(side, random);
        EliminationOrdering elimination = order_elimination(neighbours);
        tree = std::move(elimination.tree);
        upper = upper_in(neighbours, elimination.order);
        for (Index column = 0; column < upper.n(); ++column)
            for (Index k = upper.column_offsets[column]; k < upper.column_offsets[column + 1]; ++k)
                values.push_back(upper.rows[k] == column ? 8.0 : random.symmetric());
    }

    [[nodiscard]] Columns times(const Columns& x) const
    {
        Columns product = Columns::Zero(x.rows(), 3);
        for (Index column = 0; column < upper.n(); ++column)
            for (Index k = upper.column_offsets[column]; k < upper.column_offsets[column + 1]; ++k) {
                product.row(upper.rows[k]) += values[k] * x.row(column);
                if (upper.rows[k] != column)
                    product.row(column) += values[k] * x.row(upper.rows[k]);
            }
        return product;
    }

    double& diagonal(Index unknown) { return values[usize(upper.column_offsets[unknown + 1]) - 1]; }

    static constexpr Index side = 180;
    SparsePattern upper;
    EliminationTree tree;
    std::vector<double> values;
};

/// Every third index in a thread of its own.
void run_in_three_threads(Index n, const RangeBody& body)
{
    std::array<std::thread, 3> threads;
    for (Index t = 0; t < 3; ++t)
        threads[t] = std::thread([&body, n, t] {
            for (Index i = t; i < n; i += 3)
                body(i, i + 1);
        });
    for (std::thread& thread : threads)
        thread.join();
}

/// How far results may be from exact ones, relative to them.
template <class Number>
constexpr double rounding = 1e4 * std::numeric_limits<Number>::epsilon();

}  // namespace

TEST_CASE("many right-hand sides are solved for at once, each as it is among three")
{
    RandomNumbers random(4);
    LdlWorkspace workspace;
    const auto check = [&](const SymmetricMatrix& matrix) {
        const LdlSolver solver(matrix.upper);
        const auto factor = solver.factorise<double>(matrix.values, heap(), workspace);
        REQUIRE(factor);
        const Index n = solver.n();
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, wide_ldl_row, Eigen::RowMajor>;
        const Rows right = Rows::NullaryExpr(n, wide_ldl_row, [&] { return random.symmetric(); });
        Rows solution = right;
        factor->solve_wide(solution.data());
        for (Index c = 0; c + 3 <= wide_ldl_row; ++c) {
            Columns of_three;
            factor->solve(right.middleCols<3>(c), of_three, workspace);
            CHECK(of_three == solution.middleCols<3>(c));
        }
    };
    for (const Index side : {1, 2, 5, 23})
        check(grid_matrix(side, 1.0, random));
    for (const Index n : {2, 7, 40})
        check(full_matrix(n, random));
}

TEST_CASE("three systems are solved at once, for one set of values after the other, with any workspace")
{
    RandomNumbers random(1);
    LdlWorkspace workspace;
    for (const Index side : {1, 2, 3, 9, 20, 5}) {
        const SymmetricMatrix first = grid_matrix(side, 1.0, random);
        const LdlSolver solver(first.upper);
        for (const double shift : {0.01, 1.0, 100.0}) {
            const SymmetricMatrix matrix = grid_matrix(side, shift, random);
            const Columns right = random_columns(side * side, random);
            const Columns found = solved(solver, matrix.values, right, workspace);
            CHECK((matrix.dense * found - right).norm() < 1e-11 * matrix.dense.norm());
            LdlWorkspace another;
            CHECK(solved(solver, matrix.values, right, another) == found);
            const Columns in_single = solved<float>(solver, matrix.values, right, workspace);
            CHECK((matrix.dense * in_single - right).norm() < 1e-4 * matrix.dense.norm());
            CHECK(in_single != found);
        }
    }
}

TEST_CASE("without any entries that are zero there is one block, of any width")
{
    RandomNumbers random(2);
    LdlWorkspace workspace;
    for (const Index n : {2, 3, 4, 5, 7, 8, 64, 67, 130, 201}) {
        const SymmetricMatrix matrix = full_matrix(n, random);
        LdlSolver solver(matrix.upper);
        CHECK(solver.factor_bytes<double>() == usize(n) * usize(n) * sizeof(double));
        CHECK(solver.factor_bytes<float>() == solver.factor_bytes<double>() / 2);
        const Columns right = random_columns(n, random);
        const Columns found = solved(solver, matrix.values, right, workspace);
        CHECK((found - matrix.dense.llt().solve(right)).norm() < 1e-12 * matrix.dense.norm() * found.norm());
    }
}

TEST_CASE_TEMPLATE("the last block is the Schur complement, and the others are solved for with its unknowns given",
                   Number, float, double)
{
    RandomNumbers random(3);
    LdlWorkspace workspace;
    for (const double unit : {1.0, 0x1p-200, 0x1p200})
        for (const bool is_arrow : {false, true})
            for (const Index n_last : {1, 2, 3, 4, 5, 6, 7, 8, 9, 15, 16, 17, 30, 40, 75, 100}) {
                SymmetricMatrix matrix =
                    is_arrow ? arrow_matrix(100 - n_last, n_last, random) : grid_matrix(10, 0.1, random);
                matrix.dense *= unit;
                for (double& value : matrix.values)
                    value *= unit;
                const Index n_first = 100 - n_last;
                const LdlSolver solver(matrix.upper, n_last);
                auto factor = solver.factorise<Number>(matrix.values, heap(), workspace);
                REQUIRE(factor);
                const Eigen::MatrixXd first = matrix.dense.topLeftCorner(n_first, n_first);
                const Eigen::MatrixXd coupling = matrix.dense.bottomLeftCorner(n_last, n_first);
                Eigen::MatrixXd schur = matrix.dense.bottomRightCorner(n_last, n_last);
                const Eigen::LLT<Eigen::MatrixXd> inverse(first);
                if (n_first > 0)
                    schur -= coupling * inverse.solve(coupling.transpose());
                const DenseLdl<Number> last = solver.last<Number>(workspace);
                REQUIRE(last.rows() == n_last);
                CHECK((factor->scale() * product(last) - schur).norm() < rounding<Number> * schur.norm());

                auto x = rows_of(*factor, 100);
                const Points right = random_columns(100, random);
                x.setZero();
                x.leftCols(3) = right.cast<Number>();
                factor->forward_substitute();
                Points condensed = right.bottomRows(n_last);
                if (n_first > 0)
                    condensed -= coupling * inverse.solve(right.topRows(n_first));
                const auto found = [&] { return Points(x.leftCols(3).template cast<double>()); };
                CHECK((found().bottomRows(n_last) - condensed).norm() < rounding<Number> * right.norm());
                const Points given = random_columns(n_last, random).cast<Number>().template cast<double>();
                x.bottomRows(n_last).leftCols(3) = given.cast<Number>();
                factor->back_substitute();
                CHECK(found().bottomRows(n_last) == given);
                if (n_first > 0)
                    CHECK(((first * found().topRows(n_first) + coupling.transpose() * given) / factor->scale() -
                           right.topRows(n_first))
                              .norm() < rounding<Number> * matrix.dense.norm() / factor->scale() * found().norm());
            }
}

TEST_CASE("pivots that have lost too many digits are found out")
{
    RandomNumbers random(9);
    LdlWorkspace workspace;
    // Two unknowns that are nearly one: what the first leaves of the second's diagonal is 1e-4 of it.
    SymmetricMatrix matrix = grid_matrix(6, 1.0, random);
    const double stiff = 1e4 * matrix.dense.norm();
    matrix.values[matrix.upper.slot({14, 14})] += stiff;
    matrix.values[matrix.upper.slot({15, 15})] += stiff;
    matrix.values[matrix.upper.slot({15, 14})] -= stiff;
    for (const Index n_last : {0, 6, 30}) {
        const LdlSolver solver(matrix.upper, n_last);
        CHECK(solver.factorise<float>(matrix.values, heap(), workspace));
        CHECK(solver.factorise<float>(matrix.values, heap(), workspace, 1e-6F));
        CHECK_FALSE(solver.factorise<float>(matrix.values, heap(), workspace, 1e-2F));
        CHECK_FALSE(solver.factorise<double>(matrix.values, heap(), workspace, 1e-2));
        CHECK(solver.factorise<double>(matrix.values, heap(), workspace));
    }
}

TEST_CASE("a matrix that is not positive definite is found out, and the solver goes on with others")
{
    RandomNumbers random(4);
    LdlWorkspace workspace;
    const SymmetricMatrix matrix = grid_matrix(8, 0.1, random);
    const Columns right = random_columns(64, random);
    const LdlSolver whole(matrix.upper);
    const Columns expected = solved(whole, matrix.values, right, workspace);
    for (const Index n_last : {0, 8}) {
        const LdlSolver solver(matrix.upper, n_last);
        for (const Index unknown : {0, 30, 63})
            for (const double pivot :
                 {-1.0, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                  std::numeric_limits<double>::quiet_NaN()}) {
                auto unfit = matrix.values;
                unfit[matrix.upper.slot({unknown, unknown})] = pivot;
                CHECK_FALSE(solver.factorise<double>(unfit, heap(), workspace));
                CHECK_FALSE(solver.factorise<float>(unfit, heap(), workspace));
            }
        const std::vector<double> zeros(matrix.values.size(), 0.0);
        CHECK_FALSE(solver.factorise<double>(zeros, heap(), workspace));
        CHECK_FALSE(solver.factorise<float>(zeros, heap(), workspace));
        CHECK(solved(whole, matrix.values, right, workspace) == expected);
    }
}

TEST_CASE("without unknowns there is nothing to do")
{
    LdlWorkspace workspace;
    LdlSolver solver{SparsePattern{}};
    CHECK(solver.factor_bytes<double>() == 0);
    CHECK(solved(solver, {}, Columns(0, 3), workspace).rows() == 0);
    CHECK(solver.last<double>(workspace).rows() == 0);
}

TEST_CASE("from the second time on nothing is allocated")
{
    RandomNumbers random(5);
    LdlWorkspace workspace;
    const SymmetricMatrix large = grid_matrix(12, 1.0, random);
    const SymmetricMatrix small = grid_matrix(5, 1.0, random);
    LdlSolver large_solver(large.upper);
    LdlSolver with_last(large.upper, 12);
    LdlSolver small_solver(small.upper);
    const Columns right = random_columns(144, random);
    const Columns small_right = random_columns(25, random);
    Columns solution(144, 3);
    Columns small_solution(25, 3);
    FactorPool pool;
    const auto step = [&] {
        const long before = n_allocations();
        auto factor = large_solver.factorise<double>(large.values, pool, workspace);
        factor->solve(right, solution, workspace);
        auto small_factor = small_solver.factorise<float>(small.values, pool, workspace);
        small_factor->solve(small_right, small_solution, workspace);
        CHECK(with_last.factorise<float>(large.values, pool, workspace));
        return n_allocations() - before;
    };
    CHECK(step() > 0);
    CHECK(step() == 0);
}

TEST_CASE(
    "systems are solved with the tree that comes with the elimination ordering, or with none where there is a hub")
{
    RandomNumbers random(6);
    LdlWorkspace workspace;
    for (const bool has_hub : {false, true}) {
        const SparsePattern triangles = triangle_neighbours(20, random);
        std::vector<MatrixEntry> entries;
        for (Index v = 0; v < triangles.n(); ++v) {
            for (Index k = triangles.column_offsets[v]; k < triangles.column_offsets[v + 1]; ++k)
                entries.push_back({v, triangles.rows[k]});
            if (has_hub)
                entries.insert(entries.end(), {{v, triangles.n()}, {triangles.n(), v}});
        }
        const SparsePattern neighbours = make_pattern(triangles.n() + 1, entries);
        const auto [order, tree] = order_elimination(neighbours);
        CHECK(tree.parent.empty() == has_hub);
        const SparsePattern upper = upper_in(neighbours, order);
        const Index n = upper.n();
        std::vector<double> values;
        Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
        for (Index column = 0; column < n; ++column)
            for (Index k = upper.column_offsets[column]; k < upper.column_offsets[column + 1]; ++k) {
                const Index row = upper.rows[k];
                values.push_back(row == column ? 500.0 : random.symmetric());
                dense(row, column) = dense(column, row) = values.back();
            }
        LdlSolver solver(upper, {}, tree);
        const Columns right = random_columns(n, random);
        const Columns found = solved(solver, values, right, workspace);
        CHECK((dense * found - right).norm() < 1e-12 * right.norm());
        CHECK(100 * solver.factor_bytes<double>() <= 101 * LdlSolver(upper).factor_bytes<double>());
    }
}

TEST_CASE_TEMPLATE("several threads factorise one matrix, with the same bits as one", Number, float, double)
{
    RandomNumbers random(7);
    const OrderedTriangles matrix(random);
    const Index n = matrix.upper.n();
    const Columns right = random_columns(n, random);
    LdlWorkspace workspace;
    const LdlSolver in_order(matrix.upper, {}, matrix.tree);
    const LdlSolver by_one(matrix.upper, {}, matrix.tree, run_serially);
    const Columns found = solved<Number>(by_one, matrix.values, right, workspace);
    CHECK((matrix.times(found) - right).norm() < rounding<Number> * right.norm());
    const Columns one_by_one = solved<Number>(in_order, matrix.values, right, workspace);
    CHECK(found != one_by_one);
    CHECK((found - one_by_one).norm() < rounding<Number> * found.norm());
    for (const Executor& exec : {Executor(run_backwards), Executor(run_in_three_threads)}) {
        const LdlSolver solver(matrix.upper, {}, matrix.tree, exec);
        CHECK(solved<Number>(solver, matrix.values, right, workspace) == found);
    }
}

TEST_CASE("several threads find that a matrix is not positive definite, or that a pivot has lost its digits")
{
    RandomNumbers random(8);
    OrderedTriangles matrix(random);
    const Index last = matrix.upper.n() - 1;
    const LdlSolver solver(matrix.upper, {}, matrix.tree, run_in_three_threads);
    LdlWorkspace workspace;
    // The last entry of the inverse is that of the last pivot.
    Columns unit = Columns::Zero(last + 1, 3);
    unit(last, 0) = 1.0;
    const double pivot = 1.0 / solved(solver, matrix.values, unit, workspace)(last, 0);
    for (const Index unknown : {Index{0}, last / 2, last}) {
        const double kept = std::exchange(matrix.diagonal(unknown), -1.0);
        CHECK_FALSE(solver.factorise<double>(matrix.values, heap(), workspace));
        CHECK_FALSE(solver.factorise<float>(matrix.values, heap(), workspace));
        matrix.diagonal(unknown) = kept;
    }
    CHECK(solver.factorise<double>(matrix.values, heap(), workspace, 1e-6));
    matrix.diagonal(last) -= (1.0 - 1e-10) * pivot;
    CHECK(solver.factorise<double>(matrix.values, heap(), workspace));
    CHECK_FALSE(solver.factorise<double>(matrix.values, heap(), workspace, 1e-6));
}
