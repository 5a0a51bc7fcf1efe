#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "solvers/denoising/chebyshev.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

constexpr Index n_terms = 48;

double filter(double amount, double eigenvalue)
{
    return 1.0 / (1.0 + std::pow(amount * eigenvalue, 3));
}

Eigen::MatrixXd dense_laplacian(const FilterSample& sample)
{
    const Index n = sample.neighbours.size();
    Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
        const auto neighbours = sample.neighbours[i];
        if (!neighbours.empty())
            laplacian(i, i) = 1.0;
        for (const Index j : neighbours)
            laplacian(i, j) = -1.0 / static_cast<double>(neighbours.size());
    }
    return laplacian;
}

Signals filtered(const FilterSample& sample, const Signals& signals, double amount, const Executor& exec)
{
    const Eigen::VectorXd coefficients =
        ChebyshevExpansion(n_terms).coefficients([&](double eigenvalue) { return filter(amount, eigenvalue); });
    Signals result = Signals::Zero(signals.rows(), 4);
    visit_chebyshev_basis(
        sample, signals, n_terms, [&](Index j, const Signals& term) { result += coefficients[j] * term; }, exec);
    return result;
}

}  // namespace

TEST_CASE("a Chebyshev expansion is the function on [0, 2], the nearer the smoother it is")
{
    const ChebyshevExpansion expansion(n_terms);
    for (const auto& filter_and_error : {std::pair{0.25, 1e-12}, {1.0, 1e-12}, {4.0, 1e-6}, {12.0, 5e-4}}) {
        const double amount = filter_and_error.first;
        CAPTURE(amount);
        const Eigen::VectorXd coefficients =
            expansion.coefficients([&](double eigenvalue) { return filter(amount, eigenvalue); });
        REQUIRE(coefficients.size() == n_terms);
        for (double eigenvalue = 0.0; eigenvalue <= 2.0; eigenvalue += 0.05) {
            double value = 0.0;
            for (Index j = 0; j < n_terms; ++j)
                value += coefficients[j] * std::cos(j * std::acos(std::clamp(eigenvalue - 1.0, -1.0, 1.0)));
            CHECK(std::abs(value - filter(amount, eigenvalue)) < filter_and_error.second);
        }
    }
}

TEST_CASE("filters are combinations of the basis: the solutions of their equations, boundaries and all")
{
    for (const PolygonMesh& mesh :
         {test::triangle_grid(9, 7), test::quad_torus(8, 6), test::hexagon_sheet(5, 6), test::cylinder(7, 5)}) {
        const Topology topology = make_topology(mesh);
        const FilterSample sample = take_filter_sample(mesh, topology);
        const Signals signals = Signals::Random(mesh.n_vertices(), 4);
        const Eigen::MatrixXd laplacian = dense_laplacian(sample);
        for (const double amount : {0.3, 1.0, 3.0}) {
            const Eigen::MatrixXd scaled = amount * laplacian;
            const Eigen::MatrixXd matrix =
                Eigen::MatrixXd::Identity(scaled.rows(), scaled.rows()) + scaled * scaled * scaled;
            const Signals solution = matrix.partialPivLu().solve(Eigen::MatrixXd(signals));
            const Signals result = filtered(sample, signals, amount, run_serially);
            CHECK((result - solution).cwiseAbs().maxCoeff() < 1e-6);
            for (Index v = 0; v < mesh.n_vertices(); ++v)
                if (!topology.moves(v))
                    CHECK((result.row(v) - signals.row(v)).cwiseAbs().maxCoeff() < 1e-6);
            CHECK(filtered(sample, signals, amount, run_in_parallel) == result);
        }
    }
}
