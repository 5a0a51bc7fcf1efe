#include <cmath>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "solvers/krylov/conjugate_gradients.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

/// A X = B with a symmetric positive definite A, whose products are rounded to single precision.
struct DefiniteSystem {
    explicit DefiniteSystem(Index n)
        : matrix(n, n)
        , right(n, 3)
    {
        RandomNumbers random(7);
        for (double& entry : matrix.reshaped())
            entry = random.symmetric();
        matrix = Eigen::MatrixXd(matrix * matrix.transpose()) + 0.5 * Eigen::MatrixXd::Identity(n, n);
        for (double& entry : right.reshaped())
            entry = random.symmetric();
    }

    /// From X = 0, preconditioned by the diagonal.
    IterationResult solve(const IterationStop& stop, Points& x) const
    {
        const auto multiply = [&](const Points& p, Points& q) { q = (matrix * p).cast<float>().cast<double>(); };
        const auto precondition = [&](const Points& r, Points& z) { z = matrix.diagonal().asDiagonal().inverse() * r; };
        const auto measure = [&](const Points& at_x, Points& r) { r = right - matrix * at_x; };
        ConjugateGradientVectors vectors(static_cast<Index>(right.rows()),
                                         [](std::initializer_list<VectorPair> pairs, const Executor&) {
                                             std::vector<Point> products;
                                             for (const auto& [a, b] : pairs)
                                                 products.emplace_back(a.cwiseProduct(b).colwise().sum());
                                             return products;
                                         });
        x.setZero(right.rows(), 3);
        vectors.begin(right, run_serially);
        return conjugate_gradients(PreconditionedEquations{multiply, precondition, measure}, stop, x, vectors,
                                   run_serially);
    }

    /// The largest of the columns, relative to the right-hand side.
    [[nodiscard]] double residual(const Points& x) const
    {
        return ((right - matrix * x).colwise().norm().array() / right.colwise().norm().array()).maxCoeff();
    }

    Eigen::MatrixXd matrix;
    Points right;
};

}  // namespace

TEST_CASE("conjugate gradients reach far below what their products are rounded to")
{
    for (const Index n : {1, 3, 20, 60}) {
        CAPTURE(n);
        const DefiniteSystem system(n);
        Points x;
        const IterationResult result = system.solve({1e-11, 2000}, x);
        CHECK(result.residual <= 1e-11);
        CHECK(std::abs(system.residual(x) - result.residual) <= 0.1 * result.residual + 1e-15);
        CHECK_FALSE(result.stagnated);
        CHECK(result.iterations > 0);
    }
}

TEST_CASE("conjugate gradients end in stagnation, or where iterations run out")
{
    const DefiniteSystem system(30);
    Points x;
    const IterationResult stagnant = system.solve({1e-200, 5000}, x);
    CHECK(stagnant.stagnated);
    CHECK(stagnant.iterations < 5000);
    CHECK(system.residual(x) < 1e-11);
    const IterationResult short_of_goal = system.solve({1e-12, 5}, x);
    CHECK(short_of_goal.iterations == 5);
    CHECK_FALSE(short_of_goal.stagnated);
    CHECK(short_of_goal.residual > 1e-12);
}

TEST_CASE("right-hand sides that vanish, and no unknowns, do no harm to conjugate gradients")
{
    DefiniteSystem system(20);
    system.right.col(1).setZero();
    Points x;
    CHECK(system.solve({1e-10, 500}, x).residual <= 1e-10);
    CHECK(x.col(1).isZero(0.0));
    CHECK(DefiniteSystem(0).solve({1e-10, 500}, x).iterations == 0);
}
