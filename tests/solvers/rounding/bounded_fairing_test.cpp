#include <cmath>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "solvers/denoising/vertex_averages.h"
#include "solvers/rounding/bounded_fairing.h"
#include "tests/support/digitised.h"

using namespace seamflow;

namespace {

/// Rounded heights, and boxes of half a step around them.
struct Problem {
    PolygonMesh mesh = test::rounded(
        test::height_grid(14, [](double x, double y) { return 2.0 * std::sin(x / 4.0) + 0.2 * y; }), Point(0, 0, 1));
    Points half_widths = Point(0.0, 0.2, 0.5).replicate(mesh.n_vertices(), 1);
    Topology topology = make_topology(mesh);
    VertexAverages averages{mesh, topology};

    Problem() { half_widths.row(20).setZero(); }

    [[nodiscard]] Points faired(const FairingStop& stop, FairingReport& report,
                                const Executor& exec = run_serially) const
    {
        Points positions = mesh.vertices;
        report = fair_in_boxes(averages.neighbours(), {mesh.vertices, half_widths}, stop, positions, exec);
        return positions;
    }

    /// LᵀL X, from a dense L.
    [[nodiscard]] Points gradient(const Points& positions) const
    {
        const Index n = mesh.n_vertices();
        Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
        for (Index v = 0; v < n; ++v)
            for (const Index w : averages.neighbours()[v]) {
                laplacian(v, v) += 1.0;
                laplacian(v, w) -= 1.0;
            }
        laplacian *= static_cast<double>(n) / static_cast<double>(averages.neighbours().values.size());
        return laplacian.transpose() * laplacian * positions;
    }
};

}  // namespace

TEST_CASE("no motion within the boxes makes the surface fairer")
{
    const Problem problem;
    FairingReport report;
    const Points positions = problem.faired({20000, 1e-13}, report);
    const Points gradient = problem.gradient(positions);
    const double scale = problem.gradient(problem.mesh.vertices).cwiseAbs().maxCoeff();
    int n_at_bounds = 0;
    for (Index v = 0; v < positions.rows(); ++v)
        for (int axis = 0; axis < 3; ++axis) {
            const double motion = positions(v, axis) - problem.mesh.vertices(v, axis);
            const double width = problem.half_widths(v, axis);
            CHECK(std::abs(motion) <= width * (1.0 + 1e-12));
            const bool is_at_bound = std::abs(motion) > width - 1e-9;
            n_at_bounds += is_at_bound && width > 0.0 ? 1 : 0;
            // Inside of a box nothing is left to gain; at a bound, only beyond it.
            if (!is_at_bound)
                CHECK(std::abs(gradient(v, axis)) < 1e-7 * scale);
            else if (width > 0.0)
                CHECK(gradient(v, axis) * motion < 1e-7 * scale);
            if (width == 0.0)
                CHECK(positions(v, axis) == problem.mesh.vertices(v, axis));
        }
    CHECK(n_at_bounds > 10);
}

TEST_CASE("a fairing ends when motions are small, and says so")
{
    const Problem problem;
    FairingReport loose;
    FairingReport tight;
    FairingReport cut_off;
    const Points roughly = problem.faired({20000, 1e-2}, loose);
    const Points exactly = problem.faired({20000, 1e-12}, tight);
    const Points unfinished = problem.faired({7, 1e-12}, cut_off);
    CHECK(loose.last_motion <= 1e-2);
    CHECK(tight.last_motion <= 1e-12);
    CHECK(loose.iterations < tight.iterations);
    CHECK(tight.iterations < 20000);
    CHECK((roughly - exactly).cwiseAbs().maxCoeff() < 0.1);
    CHECK(cut_off.iterations == 7);
    CHECK((unfinished - exactly).cwiseAbs().maxCoeff() > 1e-6);
    CHECK(cut_off.last_motion > 1e-12);
}

TEST_CASE("a fairing has the same bits however loops are run")
{
    const Problem problem;
    FairingReport serial;
    FairingReport parallel;
    CHECK(problem.faired({300, 1e-6}, serial) == problem.faired({300, 1e-6}, parallel, run_in_parallel));
    CHECK(serial.iterations == parallel.iterations);
}
