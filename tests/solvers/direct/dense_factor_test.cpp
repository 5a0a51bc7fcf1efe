#include <utility>

#include <Eigen/Cholesky>
#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "solvers/direct/dense_factor.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

/// Three columns of n numbers, and the room after them.
class Column3 {
  public:
    explicit Column3(Index n)
        : n_(n)
    {
        numbers_.assign(3 * DenseFactor::room(n));
    }
    explicit Column3(const Eigen::Matrix<float, Eigen::Dynamic, 3>& values)
        : Column3(static_cast<Index>(values.rows()))
    {
        map().topRows(n_) = values;
    }

    [[nodiscard]] FloatColumns columns() { return columns_at(numbers_.data(), DenseFactor::room(n_)); }
    [[nodiscard]] Eigen::MatrixXd values() const { return map().topRows(n_).cast<double>(); }
    [[nodiscard]] bool is_zero_from(Index n) const { return map().bottomRows(map().rows() - n).isZero(0.0F); }

  private:
    [[nodiscard]] Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3>> map() const
    {
        return {numbers_.data(), static_cast<Eigen::Index>(DenseFactor::room(n_)), 3};
    }
    [[nodiscard]] Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3>> map()
    {
        return {numbers_.data(), static_cast<Eigen::Index>(DenseFactor::room(n_)), 3};
    }

    Index n_;
    AlignedFloats numbers_;
};

}  // namespace

TEST_CASE("a factorisation in double precision is multiplied with, and solved for, in single precision")
{
    RandomNumbers random(3);
    for (const Index n : {1, 2, 4, 7, 16, 17, 21, 40, 67}) {
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
        factor.take(DenseLdl<double>(stored.data(), n, n), 1.0);
        const Eigen::MatrixXd S = L * diagonal.asDiagonal() * L.transpose();
        Eigen::Matrix<float, Eigen::Dynamic, 3> v(n, 3);
        for (float& value : v.reshaped())
            value = static_cast<float>(random.symmetric());
        auto root = Column3(v);
        Column3 product(Eigen::Matrix<float, Eigen::Dynamic, 3>::Constant(n, 3, 7.0F));
        factor.multiply(root.columns(), product.columns());
        CHECK((factor.scale() * product.values() - S * v.cast<double>()).norm() < 1e-5 * (1.0 + S.norm()));
        const Eigen::MatrixXd exact_root =
            (diagonal / factor.scale()).cwiseSqrt().asDiagonal() * L.transpose() * v.cast<double>();
        CHECK((root.values() - exact_root).norm() < 1e-5 * (1.0 + exact_root.norm()));
        for (Index i = 0; i < n; ++i)
            CHECK(factor.diagonal()[i] == test::relative(S(i, i), 1e-13));
        auto solution = Column3(v);
        Column3 scratch(n);
        factor.solve(solution.columns(), scratch.columns());
        const Eigen::MatrixXd exact = solution.values() / factor.scale();
        CHECK((S * exact - v.cast<double>()).norm() < 1e-5 * (1.0 + S.norm() * exact.norm()));
        for (const Column3& columns : {product, root, solution, scratch})
            CHECK(columns.is_zero_from(n));
    }
}

TEST_CASE("a matrix without rows has products, too")
{
    DenseFactor factor;
    factor.take(DenseLdl<double>(nullptr, 0, 0), 1.0);
    Column3 none(0);
    Column3 scratch(0);
    factor.multiply(none.columns(), scratch.columns());
    factor.solve(none.columns(), scratch.columns());
    CHECK(factor.diagonal().empty());
}

TEST_CASE("a factorisation in any unit is the same but for its scale")
{
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> stored;
    stored << 3.0, 0.0, 0.0, 0.5, 0.2, 0.0, -0.25, 0.7, 1.0;
    DenseFactor factor;
    factor.take(DenseLdl<double>(stored.data(), 3, 3), 1.0);
    CHECK(factor.scale() == 2.0);
    for (const double unit : {0x1p-300, 0x1p-100, 0x1p100, 0x1p300}) {
        auto scaled = stored;
        scaled.diagonal() *= unit;
        DenseFactor other;
        other.take(DenseLdl<double>(scaled.data(), 3, 3), 1.0);
        CHECK(other.scale() == 2.0 * unit);
        const auto applied = [&](const DenseFactor& to, auto function) {
            Column3 result(Eigen::Matrix3f::Identity());
            Column3 other_result(3);
            (to.*function)(result.columns(), other_result.columns());
            return std::pair(result.values(), other_result.values());
        };
        CHECK(applied(other, &DenseFactor::multiply) == applied(factor, &DenseFactor::multiply));
        CHECK(applied(other, &DenseFactor::solve) == applied(factor, &DenseFactor::solve));
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(other.diagonal()[i] == unit * factor.diagonal()[i]);
    }
}
