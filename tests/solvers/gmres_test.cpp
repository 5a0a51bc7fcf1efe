#include <array>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "samples/common/meshes/random_numbers.h"
#include "solvers/gmres.h"

using namespace seamflow;

namespace {

struct System {
    Eigen::MatrixXd matrix;
    Points right;

    [[nodiscard]] Gmres::Multiply multiply() const
    {
        return [this](const Points& p, Points& product) { product = matrix * p; };
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

}  // namespace

TEST_CASE("GMRES solves what is neither symmetric nor definite, in a third as many products as there are unknowns")
{
    RandomNumbers random(1);
    for (const Index n : {1, 2, 3, 10, 60, 150}) {
        CAPTURE(n);
        const System system = random_system(n, random);
        Points x = Points::Zero(n, 3);
        Gmres gmres(n);
        const int products = gmres.improve(system.multiply(), system.right, 1e-9, 1000, x, run_serially);
        CHECK(residual_of(system, x) < 1e-8);
        CHECK(products <= (n + 2) / 3);
    }
}

TEST_CASE("GMRES may begin anywhere, and improves however few products it may have")
{
    RandomNumbers random(2);
    const System system = random_system(90, random);
    Points x = random_points(90, random);
    Gmres gmres(90);
    double before = residual_of(system, x);
    CHECK(gmres.improve(system.multiply(), system.right - system.matrix * x, 0.0, 0, x, run_serially) == 0);
    CHECK(residual_of(system, x) == before);
    for (const int most : {1, 5, 20, 30}) {
        CHECK(gmres.improve(system.multiply(), system.right - system.matrix * x, 1e-8, most, x, run_serially) == most);
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
        const int products = Gmres(40).improve(system.multiply(), system.right, 1e-10, 40, x, run_serially);
        CHECK(x.allFinite());
        CHECK(residual_of(system, x) < 1e-9);
        CHECK(products <= std::array{20, 20, 0, 1, 10}[static_cast<std::size_t>(kind)]);
    }
}

TEST_CASE("a regular matrix whose powers lead nowhere for long is solved in the end")
{
    constexpr Index n = 30;
    System system{Eigen::MatrixXd::Zero(n, n), Points::Zero(n, 3)};
    for (Index i = 0; i < n; ++i)
        system.matrix((i + 1) % n, i) = 1.0;
    system.right(0, 0) = 1.0;
    Points x = Points::Zero(n, 3);
    Gmres gmres(n);
    CHECK(gmres.improve(system.multiply(), system.right, 1e-12, n - 1, x, run_serially) == n - 1);
    CHECK(x.allFinite());
    CHECK(residual_of(system, x) == doctest::Approx(1.0));
    x.setZero();
    CHECK(gmres.improve(system.multiply(), system.right, 1e-12, 2 * n, x, run_serially) == n);
    CHECK(residual_of(system, x) < 1e-12);
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
        Gmres gmres(60);
        gmres.improve(system.multiply(), system.right, 1e-6, 100, x, run_serially);
        const double expected = 1.0 / smallest;
        CHECK(gmres.amplification() <= doctest::Approx(expected));
        CHECK(gmres.amplification() > 0.5 * expected);
        const double error = (x - Points(system.matrix.partialPivLu().solve(system.right))).norm();
        CHECK(error < 1e-6 * Gmres::most_amplification);
    }
}
