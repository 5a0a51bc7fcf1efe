#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "solvers/krylov/gmres.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

struct System {
    Eigen::MatrixXd matrix;
    Points right;

    [[nodiscard]] auto multiply() const
    {
        return [this](const Points& p, Points& product) { product = matrix * p; };
    }

    /// A cycle that starts from X, with a basis of its own.
    [[nodiscard]] GmresCycle cycle(double goal, int most, Points& x) const
    {
        KrylovBasis V(static_cast<Index>(right.rows()));
        const Points residual = right - matrix * x;
        return gmres_cycle(multiply(), goal, most, {V, x, residual}, run_serially);
    }
};

Points random_points(Index n, RandomNumbers& random)
{
    Points points(n, 3);
    for (double& entry : points.reshaped())
        entry = random.symmetric();
    return points;
}

/// Not symmetric, and not definite.
System random_system(Index n, RandomNumbers& random)
{
    Eigen::MatrixXd A(n, n);
    for (double& entry : A.reshaped())
        entry = random.symmetric();
    return {A, random_points(n, random)};
}

double residual_of(const System& system, const Points& x)
{
    return (system.right - system.matrix * x).norm();
}

/// A solution with GMRES begun anew, and its residuals: at the beginning and after each cycle.
struct Restarted {
    GmresResult result;
    std::vector<double> residuals;

    /// The most cycles one after the other that have left more than 95 % of the residual.
    [[nodiscard]] int longest_plateau() const
    {
        int longest = 0;
        int length = 0;
        for (std::size_t i = 1; i < residuals.size(); ++i) {
            length = residuals[i] > 0.95 * residuals[i - 1] ? length + 1 : 0;
            longest = std::max(longest, length);
        }
        return longest;
    }
};

Restarted solve(const System& system, const IterationStop& stop, int most_in_cycle)
{
    const auto n = static_cast<Index>(system.right.rows());
    Points x = Points::Zero(n, 3);
    Points residual = system.right;
    Restarted restarted{.result = {}, .residuals = {residual.norm()}};
    const auto measure = [&] {
        residual = system.right - system.matrix * x;
        restarted.residuals.push_back(residual.norm());
    };
    KrylovBasis V(n);
    restarted.result = gmres(system.multiply(), measure, stop, most_in_cycle, {V, x, residual}, run_serially);
    CHECK(restarted.result.residual == test::relative(residual_of(system, x), 1e-5));
    return restarted;
}

/// One right-hand side, turned from one unknown to the next: cycles of fewer products get nowhere.
System rotation(Index n)
{
    System system{Eigen::MatrixXd::Zero(n, n), Points::Zero(n, 3)};
    for (Index i = 0; i < n; ++i)
        system.matrix((i + 1) % n, i) = 1.0;
    system.right(0, 0) = 1.0;
    return system;
}

}  // namespace

TEST_CASE("GMRES solves what is neither symmetric nor definite, in a third as many products as there are unknowns")
{
    RandomNumbers random(1);
    for (const Index n : {1, 2, 3, 10, 60, 150}) {
        CAPTURE(n);
        const System system = random_system(n, random);
        Points x = Points::Zero(n, 3);
        const int products = system.cycle(1e-9, 1000, x).iterations;
        CHECK(residual_of(system, x) < 1e-8);
        CHECK(products <= (n + 2) / 3);
    }
}

TEST_CASE("GMRES may begin anywhere, and improves however few products it may have")
{
    RandomNumbers random(2);
    const System system = random_system(90, random);
    Points x = random_points(90, random);
    double before = residual_of(system, x);
    CHECK(system.cycle(0.0, 0, x).iterations == 0);
    CHECK(residual_of(system, x) == before);
    for (const int most : {1, 5, 20, 30}) {
        CHECK(system.cycle(1e-8, most, x).iterations == most);
        CHECK(residual_of(system, x) < before);
        before = residual_of(system, x);
    }
    CHECK(before < 1e-7);
}

TEST_CASE("right-hand sides that depend on each other, or vanish, and invariant subspaces do no harm")
{
    RandomNumbers random(3);
    for (const int kind : {0, 1, 2, 3, 4}) {
        CAPTURE(kind);
        System system = random_system(40, random);
        if (kind == 0)
            system.right.col(1).setZero();
        else if (kind == 1)
            system.right.col(2) = -2.0 * system.right.col(0);
        else if (kind == 2)
            system.right.setZero();
        else if (kind == 3)
            system.matrix.setIdentity();
        else
            system.matrix =
                Eigen::VectorXd::LinSpaced(40, -4.0, 5.0).array().round().matrix().asDiagonal().toDenseMatrix() +
                0.5 * Eigen::MatrixXd::Identity(40, 40);
        Points x = Points::Zero(40, 3);
        const int products = system.cycle(1e-10, 40, x).iterations;
        CHECK(x.allFinite());
        CHECK(residual_of(system, x) < 1e-9);
        CHECK(products <= std::array{20, 20, 0, 1, 10}[static_cast<std::size_t>(kind)]);
    }
}

TEST_CASE("a regular matrix whose powers lead nowhere for long is solved in the end")
{
    constexpr Index n = 30;
    const System system = rotation(n);
    Points x = Points::Zero(n, 3);
    CHECK(system.cycle(1e-12, n - 1, x).iterations == n - 1);
    CHECK(x.allFinite());
    CHECK(residual_of(system, x) == test::relative(1.0, 1e-5));
    x.setZero();
    CHECK(system.cycle(1e-12, 2 * n, x).iterations == n);
    CHECK(residual_of(system, x) < 1e-12);
}

TEST_CASE("the residual that ends the iteration is the true one, however much alike the products become")
{
    RandomNumbers random(5);
    constexpr Index n = 150;
    const Eigen::MatrixXd left_factor = random_system(n, random).matrix.householderQr().householderQ();
    const Eigen::MatrixXd right_factor = random_system(n, random).matrix.householderQr().householderQ();
    for (const double decay : {0.9, 0.8})
        for (const Index n_columns : {1, 3}) {
            CAPTURE(decay);
            CAPTURE(n_columns);
            const auto power = [decay](Eigen::Index i) { return std::pow(decay, i); };
            const auto values = Eigen::VectorXd::NullaryExpr(n, power);
            System system{left_factor * values.asDiagonal() * right_factor.transpose(), random_points(n, random)};
            system.matrix.diagonal().array() += 0.01;
            system.right.rightCols(3 - n_columns).setZero();
            Points x = Points::Zero(n, 3);
            const double goal = 1e-12 * system.right.norm();
            CHECK(system.cycle(goal, n, x).iterations < n / 2);
            CHECK(residual_of(system, x) <= goal);
        }
}

TEST_CASE("the amplification is the norm of the inverse, and tightens the goal where it is large")
{
    RandomNumbers random(4);
    System system = random_system(60, random);
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(system.matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(60, 2.0, 1.0);
    for (const double smallest : {0.5, 1e-3, 1e-5}) {
        values[59] = smallest;
        system.matrix = svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose();
        Points x = Points::Zero(60, 3);
        const double amplification = system.cycle(1e-6, 100, x).amplification;
        const double expected = 1.0 / smallest;
        CHECK(amplification <= (1.0 + 1e-5) * expected);
        CHECK(amplification > 0.5 * expected);
        const double error = (x - Points(system.matrix.partialPivLu().solve(system.right))).norm();
        CHECK(error < 1e-6 * most_amplification);
    }
}

TEST_CASE("GMRES that is begun anew measures its residual, and ends where that has reached the goal")
{
    RandomNumbers random(6);
    System system = random_system(60, random);
    system.matrix.diagonal().array() += 12.0;
    const Restarted restarted = solve(system, {1e-8, 1000}, 5);
    CHECK(restarted.result.residual <= 1e-8);
    CHECK_FALSE(restarted.result.stagnated);
    CHECK(restarted.result.iterations > 5);
    CHECK(restarted.result.iterations <= 5 * static_cast<int>(restarted.residuals.size() - 1));
    CHECK(solve(system, {1e-8, 7}, 5).result.iterations == 7);
    CHECK(solve(system, {1e-8, 0}, 5).result.iterations == 0);
    CHECK(solve(system, {100.0 * system.right.norm(), 1000}, 5).result.iterations == 0);
}

TEST_CASE("a plateau of two cycles is crossed")
{
    struct Plateau {
        Index n;
        double shift;
        int iterations_in_cycle;
        std::uint32_t seed;
    };
    // Found by trying.
    for (const Plateau& plateau : {Plateau{6, 2.0, 1, 19}, Plateau{20, 3.0, 2, 11}}) {
        CAPTURE(plateau.n);
        RandomNumbers random(plateau.seed);
        System system = random_system(plateau.n, random);
        system.matrix.diagonal().array() += plateau.shift;
        system.right.rightCols(2).setZero();
        const Restarted restarted = solve(system, {1e-8, 200}, plateau.iterations_in_cycle);
        CHECK(restarted.longest_plateau() == 2);
        CHECK(restarted.result.residual <= 1e-8);
        CHECK_FALSE(restarted.result.stagnated);
    }
}

TEST_CASE("three cycles one after the other that lead nowhere are the end, and said to be")
{
    const System system = rotation(30);
    const IterationResult stagnant = solve(system, {1e-8, 1000}, 5).result;
    CHECK(stagnant.stagnated);
    CHECK(stagnant.iterations == 15);
    CHECK(stagnant.residual == test::relative(1.0, 1e-5));
    for (const int iterations : {5, 10, 15}) {
        CAPTURE(iterations);
        const IterationResult short_of_goal = solve(system, {1e-8, iterations}, 5).result;
        CHECK_FALSE(short_of_goal.stagnated);
        CHECK(short_of_goal.iterations == iterations);
    }
    CHECK_FALSE(solve(system, {1e-8, 1000}, 30).result.stagnated);
}
