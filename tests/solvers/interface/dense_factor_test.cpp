#include <Eigen/Cholesky>
#include <doctest/doctest.h>

#include "samples/common/meshes/random_numbers.h"
#include "solvers/interface/dense_factor.h"

using namespace seamflow;

TEST_CASE("a factorisation in double precision is multiplied with, and solved for, in single precision")
{
    RandomNumbers random(3);
    for (const Index n : {1, 2, 7, 40}) {
        Eigen::MatrixXd L = Eigen::MatrixXd::Identity(n, n);
        Eigen::VectorXd diagonal(n);
        for (Index i = 0; i < n; ++i) {
            diagonal[i] = 1.5 + random.symmetric();
            for (Index k = 0; k < i; ++k)
                L(i, k) = random.below(4) == 0 ? 0.0 : 0.3 * random.symmetric();
        }
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> stored = L;
        stored.diagonal() = diagonal;
        stored.triangularView<Eigen::StrictlyUpper>().setConstant(99.0);
        DenseFactor factor;
        factor.take(DenseLdl(stored.data(), n, n));
        const Eigen::MatrixXd S = L * diagonal.asDiagonal() * L.transpose();
        Eigen::Matrix<float, Eigen::Dynamic, 3> v(n, 3);
        for (float& value : v.reshaped())
            value = static_cast<float>(random.symmetric());
        const auto columns = [](auto& m) { return FloatColumns{m.col(0).data(), m.col(1).data(), m.col(2).data()}; };
        auto product = v;
        factor.multiply(columns(product));
        CHECK((product.cast<double>() - S * v.cast<double>()).norm() < 1e-5 * (1.0 + S.norm()));
        auto halves = v;
        factor.multiply_by_root_transposed(columns(halves));
        CHECK(halves.cast<double>().squaredNorm() ==
              doctest::Approx((v.cast<double>().transpose() * S * v.cast<double>()).trace()).epsilon(1e-4));
        factor.multiply_by_root(columns(halves));
        CHECK(halves == product);
        const std::vector<double> of_product = factor.diagonal();
        for (Index i = 0; i < n; ++i)
            CHECK(of_product[at(i)] == doctest::Approx(S(i, i)).epsilon(1e-5));
        auto solution = v;
        factor.solve(columns(solution));
        CHECK((S * solution.cast<double>() - v.cast<double>()).norm() <
              1e-5 * (1.0 + S.norm() * solution.cast<double>().norm()));
    }
}
