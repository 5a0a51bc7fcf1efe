#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "solvers/systems/block_row_matrix.h"

using namespace seamflow;

namespace {

/// A grid of width² points whose diagonal outweighs the rest, entries along edges and diagonals being off_diagonal; one
/// row is that of the identity.
Eigen::MatrixXf grid_matrix(Index width, float off_diagonal, float surplus)
{
    const Index n = width * width;
    Eigen::MatrixXf a = Eigen::MatrixXf::Zero(n, n);
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
            if (i != j && i != 5 && j != 5 && std::abs(i % width - j % width) <= 1 &&
                std::abs(i / width - j / width) <= 1) {
                // Rows are not alike.
                a(i, j) = off_diagonal * (1.0F + 0.1F * static_cast<float>((i + j) % 7));
                a(i, i) += std::abs(a(i, j));
            }
    a.diagonal().array() += surplus;
    a.row(5).setZero();
    a(5, 5) = 1.0F;
    return a;
}

BlockRowMatrix make(const Eigen::MatrixXf& a, const std::vector<Index>& blocks)
{
    const auto n = static_cast<Index>(a.rows());
    BlockRowMatrix matrix(
        blocks,
        [&](Index block) {
            IndexLists rows;
            for (Index i = blocks[block]; i < blocks[block + 1]; ++i) {
                for (Index j = 0; j < n; ++j)
                    if (i != j && a(i, j) != 0.0F)
                        rows.values.push_back(j);
                rows.close();
            }
            return rows;
        },
        run_in_parallel);
    for (std::size_t block = 0; block + 1 < blocks.size(); ++block)
        for (Index i = blocks[block]; i < blocks[block + 1]; ++i) {
            for (Index j = 0; j < n; ++j)
                if (i != j && a(i, j) != 0.0F)
                    matrix.entry({blocks[block], i}, j).value = a(i, j);
            matrix.set_diagonal(i, a(i, i));
        }
    return matrix;
}

Eigen::MatrixXf right_hand_side(Index n)
{
    std::mt19937 random(3);
    Eigen::MatrixXf b(n, 3);
    for (Index i = 0; i < n; ++i)
        for (const Index c : {0, 1, 2})
            b(i, c) = static_cast<float>(random() % 1000) / 500.0F - 1.0F;
    b.row(5).setZero();
    return b;
}

struct Solution {
    Eigen::MatrixXf x;
    BlockRowMatrix::Result result;
};

Solution solve(BlockRowMatrix& matrix, const Eigen::MatrixXf& b, double goal, float scale, const Executor& exec)
{
    for (Index i = 0; i < matrix.n_rows(); ++i)
        matrix.set_residual(i, {b(i, 0), b(i, 1), b(i, 2), 0.0F});
    matrix.factorise(exec);
    const Eigen::Array4d squared = matrix.start(scale, exec);
    Solution solution;
    solution.result = matrix.iterate(squared, goal, 1000, exec);
    solution.x.resize(matrix.n_rows(), 3);
    for (Index i = 0; i < matrix.n_rows(); ++i)
        solution.x.row(i) = matrix.increment(i).head<3>().matrix().transpose();
    return solution;
}

}  // namespace

TEST_CASE("a matrix by blocks has the entries that were set, wherever a block ends")
{
    const Eigen::MatrixXf a = grid_matrix(8, -1.0F, 0.5F);
    BlockRowMatrix matrix = make(a, {0, 10, 10, 37, 64});
    Eigen::MatrixXf seen = Eigen::MatrixXf::Zero(64, 64);
    matrix.sum_of_rows<Eigen::Array4d>(run_serially, [&](const BlockRowMatrix::BlockRow& place) -> Eigen::Array4d {
        matrix.for_each_entry(place,
                              [&](Index j, const BlockRowMatrix::Entry& entry) { seen(place.row, j) = entry.value; });
        seen(place.row, place.row) = matrix.diagonal(place.row);
        return Eigen::Array4d::Zero();
    });
    CHECK(seen == a);
}

TEST_CASE("conjugate gradients by blocks solve, whatever the sign of entries")
{
    const Eigen::MatrixXf b = right_hand_side(144);
    // With entries above zero, blocks keep the diagonal.
    for (const float off_diagonal : {-1.0F, 0.2F})
        for (const std::vector<Index>& blocks : {std::vector<Index>{0, 144}, std::vector<Index>{0, 50, 51, 100, 144}}) {
            const Eigen::MatrixXf a = grid_matrix(12, off_diagonal, 0.1F);
            BlockRowMatrix matrix = make(a, blocks);
            const Eigen::MatrixXf expected = a.cast<double>().ldlt().solve(b.cast<double>()).cast<float>();
            const Solution solution = solve(matrix, b, 1e-6, 1.0F, run_in_parallel);
            CHECK((solution.x - expected).cwiseAbs().maxCoeff() < 2e-5F * expected.cwiseAbs().maxCoeff());
            CHECK(solution.result.residual <= 1e-6);
            CHECK(solve(matrix, b, 1e-6, 1.0F, run_serially).x == solution.x);
            CHECK(solve(matrix, b, 1e-6, 4.0F, run_serially).x == 4.0F * solution.x);
        }
}

TEST_CASE("the preconditioner saves more than half of the iterations, and some with entries above zero")
{
    const Eigen::MatrixXf b = right_hand_side(1600);
    // Blocks of one row leave the diagonal.
    std::vector<Index> single(1601);
    std::iota(single.begin(), single.end(), 0);
    const auto iterations = [&](float off_diagonal, const std::vector<Index>& blocks) {
        BlockRowMatrix matrix = make(grid_matrix(40, off_diagonal, 0.01F), blocks);
        return solve(matrix, b, 1e-4, 1.0F, run_serially).result.iterations;
    };
    const std::vector<Index> two{0, 800, 1600};
    CHECK(iterations(-1.0F, two) > 2);
    CHECK(2 * iterations(-1.0F, two) < iterations(-1.0F, single));
    CHECK(3 * iterations(1.0F, two) < 2 * iterations(1.0F, single));
}
