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
        CHECK((factor.scale() * product.cast<double>() - S * v.cast<double>()).norm() < 1e-5 * (1.0 + S.norm()));
        auto halves = v;
        factor.multiply_by_root_transposed(columns(halves));
        CHECK(factor.scale() * halves.cast<double>().squaredNorm() ==
              doctest::Approx((v.cast<double>().transpose() * S * v.cast<double>()).trace()).epsilon(1e-4));
        factor.multiply_by_root(columns(halves));
        CHECK(halves == product);
        const std::vector<double> of_product = factor.diagonal();
        for (Index i = 0; i < n; ++i)
            CHECK(of_product[at(i)] == doctest::Approx(S(i, i)).epsilon(1e-5));
        auto solution = v;
        factor.solve(columns(solution));
        const Eigen::MatrixXd exact = solution.cast<double>() / factor.scale();
        CHECK((S * exact - v.cast<double>()).norm() < 1e-5 * (1.0 + S.norm() * exact.norm()));
    }
}

TEST_CASE("a factorisation in any unit is the same but for its scale")
{
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> stored;
    stored << 3.0, 0.0, 0.0, 0.5, 0.2, 0.0, -0.25, 0.7, 1.0;
    DenseFactor factor;
    factor.take(DenseLdl(stored.data(), 3, 3));
    CHECK(factor.scale() == 2.0);
    for (const double unit : {0x1p-300, 0x1p-100, 0x1p100, 0x1p300}) {
        auto scaled = stored;
        scaled.diagonal() *= unit;
        DenseFactor other;
        other.take(DenseLdl(scaled.data(), 3, 3));
        CHECK(other.scale() == 2.0 * unit);
        const Eigen::Matrix3f v = Eigen::Matrix3f::Identity();
        const auto applied = [&](const DenseFactor& to, auto function) {
            Eigen::Matrix3f result = v;
            (to.*function)({result.col(0).data(), result.col(1).data(), result.col(2).data()});
            return result;
        };
        CHECK(applied(other, &DenseFactor::multiply) == applied(factor, &DenseFactor::multiply));
        CHECK(applied(other, &DenseFactor::solve) == applied(factor, &DenseFactor::solve));
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(other.diagonal()[i] == unit * factor.diagonal()[i]);
    }
}
