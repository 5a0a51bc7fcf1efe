#include <cmath>

#include <doctest/doctest.h>

#include "solvers/conditions/predicted_side.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double predicted_time_step = 0.05;

/// Largest residual of all rows of a condition where nothing moves.
double largest_residual_at_rest(const CutMesh& cut, Laplacian laplacian)
{
    double largest = 0.0;
    const Decomposition decomposition = test::decompose(cut);
    for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
        const Points positions = localised(sub_mesh, cut.mesh.vertices);
        const auto condition = make_predicted_side(sub_mesh, laplacian);
        condition->begin_step(positions, positions, predicted_time_step, 2.0);
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            std::vector<double> row;
            const Point right = row_of(*condition, i, positions, row);
            largest = std::max(largest, (applied(condition->columns()[i], row, positions) - right).norm());
        }
    }
    return largest;
}

}  // namespace

TEST_CASE("with Δ_A a flat mesh of triangles satisfies the condition as it is, wherever it is cut")
{
    const PolygonMesh mesh = triangle_grid(9, 7);
    const CutMesh cut =
        cut_by_place("", mesh, [](const Point& c) { return c.x() + 0.3 * c.y() > 5.0 ? Index{1} : Index{0}; });
    CHECK(largest_residual_at_rest(cut, Laplacian::AlexaWardetzky) < 1e-12);
}

TEST_CASE("the row at a vertex without prediction is the row of the undecomposed step with a response by ρ")
{
    // On a grid of unit squares, Δ_F: one neighbour beyond a straight Γ, coefficients -1, ρ = e^-θ with cosh θ = 1 + 1
    // / 2dt.
    const CutMesh cut =
        cut_by_place("", quad_grid(8, 6), [](const Point& c) { return c.x() > 4.0 ? Index{1} : Index{0}; });
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes.front();
    const Points positions = localised(sub_mesh, cut.mesh.vertices);
    const auto condition = make_predicted_side(sub_mesh, Laplacian::Fujiwara);
    condition->begin_step(positions, positions, predicted_time_step, 2.0);
    const double rho = std::exp(-std::acosh(1.0 + 0.5 / predicted_time_step));
    for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
        std::vector<double> row;
        row_of(*condition, i, positions, row);
        double diagonal = 0.0;
        double others = 0.0;
        for (std::size_t k = 0; k < row.size(); ++k)
            (condition->columns()[i][k] == sub_mesh.interface.vertices[i] ? diagonal : others) += row[k];
        CHECK(diagonal == relative(1.0 + predicted_time_step * (4.0 - rho), 1e-12));
        CHECK(others == relative(-3.0 * predicted_time_step, 1e-12));
    }
}

TEST_CASE("what is predicted of the other side moves the right-hand side, and nothing else does")
{
    for (const CutMesh& cut : cut_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            const Decomposition decomposition = test::decompose(cut);
            const SubMesh& sub_mesh = decomposition.sub_meshes.front();
            const Points positions = localised(sub_mesh, cut.mesh.vertices);
            const auto condition = make_predicted_side(sub_mesh, laplacian);
            condition->begin_step(positions, positions, predicted_time_step, 2.0);
            Points lifted = positions;
            lifted.bottomRows(sub_mesh.n_halo).col(2).array() += 1.0;
            int lifted_rows = 0;
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                const Point before = condition->right_hand_side(i, positions, positions);
                const Point after = condition->right_hand_side(i, positions, lifted);
                CHECK(after.x() == before.x());
                CHECK(after.y() == before.y());
                lifted_rows += after.z() > before.z() ? 1 : 0;
            }
            CHECK((sub_mesh.interface.size() == 0 || lifted_rows > 0));
        }
}
