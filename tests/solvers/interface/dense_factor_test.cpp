#include <numeric>
#include <vector>

#include <Eigen/Cholesky>
#include <doctest/doctest.h>

#include "samples/common/meshes/random_numbers.h"
#include "solvers/interface/dense_factor.h"

using namespace seamflow;

namespace {

/// A dense L D Lᵀ by columns, as CHOLMOD stores it.
struct StoredFactor {
    std::vector<int> offsets;
    std::vector<int> counts;
    std::vector<int> rows;
    std::vector<double> values;
    [[nodiscard]] TriangularFactor view() const { return {offsets, counts, rows.data(), values.data()}; }
};

/// Entries that are zero are left out.
StoredFactor store(const Eigen::MatrixXd& L, const Eigen::VectorXd& D)
{
    StoredFactor stored;
    for (Eigen::Index column = 0; column < D.size(); ++column) {
        stored.offsets.push_back(static_cast<int>(stored.rows.size()));
        stored.rows.push_back(static_cast<int>(column));
        stored.values.push_back(D[column]);
        for (Eigen::Index row = column + 1; row < D.size(); ++row)
            if (L(row, column) != 0.0) {
                stored.rows.push_back(static_cast<int>(row));
                stored.values.push_back(L(row, column));
            }
        stored.counts.push_back(static_cast<int>(stored.rows.size()) - stored.offsets.back());
    }
    return stored;
}

}  // namespace

TEST_CASE("the last block of a factorisation is multiplied with, and solved for, in single precision")
{
    RandomNumbers random(3);
    for (const Index n : {1, 2, 7, 40}) {
        const Index last = (n + 1) / 2;
        Eigen::MatrixXd L = Eigen::MatrixXd::Identity(n, n);
        Eigen::VectorXd D(n);
        for (Index i = 0; i < n; ++i) {
            D[i] = 1.5 + random.symmetric();
            for (Index k = 0; k < i; ++k)
                L(i, k) = random.below(4) == 0 ? 0.0 : 0.3 * random.symmetric();
        }
        const StoredFactor stored = store(L, D);
        DenseFactor factor;
        factor.take_last(stored.view(), last);
        const Eigen::MatrixXd block = L.bottomRightCorner(last, last);
        const Eigen::MatrixXd S = block * D.tail(last).asDiagonal() * block.transpose();
        Eigen::Matrix<float, Eigen::Dynamic, 3> v(last, 3);
        for (float& value : v.reshaped())
            value = static_cast<float>(random.symmetric());
        const auto columns = [](auto& m) { return FloatColumns{m.col(0).data(), m.col(1).data(), m.col(2).data()}; };
        auto product = v;
        factor.multiply(columns(product));
        CHECK((product.cast<double>() - S * v.cast<double>()).norm() < 1e-5 * (1.0 + S.norm()));
        auto solution = v;
        factor.solve(columns(solution));
        CHECK((S * solution.cast<double>() - v.cast<double>()).norm() <
              1e-5 * (1.0 + S.norm() * solution.cast<double>().norm()));
    }
}
