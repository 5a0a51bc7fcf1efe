#include <cmath>

#include <doctest/doctest.h>

#include "solvers/conditions/adapted_robin.h"
#include "solvers/conditions/derivatives.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

constexpr double ventcell_time_step = 0.02;
constexpr double ventcell_p = 5.0;

/// Positions of another copy of Γ, and of what lies beyond.
Points other_copy(const Points& positions)
{
    Points other = positions;
    for (Eigen::Index v = 0; v < other.rows(); ++v)
        other.row(v) += 0.01 * Point(std::sin(3.0 * static_cast<double>(v)), std::cos(static_cast<double>(v)), 0.5);
    return other;
}

}  // namespace

TEST_CASE("the adapted Ventcell row is the Robin row and dt q ∂t")
{
    const double time_step = 0.02;
    const double p = 5.0;
    for (const double q : {0.0, 0.5})
        for_each_sub_mesh([&](const CutMesh& cut, const SubMesh& sub_mesh) {
            const Points positions = localised(sub_mesh, cut.mesh.vertices);
            AdaptedRobin robin(sub_mesh);
            const auto ventcell = make_adapted_ventcell(sub_mesh, q);
            robin.begin_step(positions, positions, time_step, p);
            ventcell->begin_step(positions, positions, time_step, p);
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                std::vector<double> robin_row;
                std::vector<double> row;
                CHECK(row_of(*ventcell, i, positions, row) == row_of(robin, i, positions, robin_row));
                std::vector<double> tangential(row.size());
                add_tangential_derivative(robin.stencils(), i, tangential_weights(sub_mesh, i, positions), 1.0,
                                          tangential);
                for (std::size_t k = 0; k < row.size(); ++k)
                    CHECK(row[k] == relative(robin_row[k] + time_step * q * tangential[k], 1e-14));
            }
        });
}

TEST_CASE("the classical right-hand side is the row of the other side, made of the other side's copy alone")
{
    for (const double q : {0.0, 0.5})
        for_each_sub_mesh([&](const CutMesh& cut, const SubMesh& sub_mesh) {
            const Points positions = localised(sub_mesh, cut.mesh.vertices);
            const Points other = other_copy(positions);
            const Points later = other_copy(other);
            const auto condition = make_ventcell(sub_mesh, q);
            condition->begin_step(positions, other, ventcell_time_step, ventcell_p);
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                const auto conormal = complement_conormal(sub_mesh, i, other);
                if (!conormal || !own_conormal(sub_mesh, i, positions))
                    continue;
                const Point normal = complement_normal_derivative(sub_mesh, i, *conormal, later);
                const Point tangential =
                    tangential_derivative(sub_mesh, i, tangential_weights(sub_mesh, i, other), later);
                const Point v = later.row(sub_mesh.interface.vertices[i]);
                const Point expected =
                    v - ventcell_time_step * ventcell_p * normal + ventcell_time_step * q * tangential;
                CHECK((condition->right_hand_side(i, positions, later) - expected).norm() < 1e-13);
            }
        });
}

TEST_CASE("the classical left-hand side is I + dt (p ∂n + q ∂t) of the sub-mesh's own copy")
{
    const double q = 0.5;
    for_each_sub_mesh([&](const CutMesh& cut, const SubMesh& sub_mesh) {
        const Points positions = localised(sub_mesh, cut.mesh.vertices);
        const auto robin = make_ventcell(sub_mesh);
        const auto ventcell = make_ventcell(sub_mesh, q);
        robin->begin_step(positions, other_copy(positions), ventcell_time_step, ventcell_p);
        ventcell->begin_step(positions, other_copy(positions), ventcell_time_step, ventcell_p);
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            const auto conormal = own_conormal(sub_mesh, i, positions);
            if (!conormal || !complement_conormal(sub_mesh, i, other_copy(positions)))
                continue;
            std::vector<double> row;
            const Point v = positions.row(sub_mesh.interface.vertices[i]);
            row_of(*robin, i, positions, row);
            const Point after_robin = applied(robin->columns()[i], row, positions);
            CHECK((after_robin - v - ventcell_time_step * ventcell_p * conormal->direction).norm() < 1e-12);
            row_of(*ventcell, i, positions, row);
            const Point tangential =
                tangential_derivative(sub_mesh, i, tangential_weights(sub_mesh, i, positions), positions);
            CHECK((applied(ventcell->columns()[i], row, positions) - after_robin - ventcell_time_step * q * tangential)
                      .norm() < 1e-12);
        }
    });
}

TEST_CASE("without a conormal the other side's copy is taken over")
{
    const CutMesh cut =
        cut_by_place("", quad_grid(8, 6), [](const Point& c) { return c.x() > 4.0 ? Index{1} : Index{0}; });
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes.front();
    const auto robin = make_ventcell(sub_mesh);
    Points positions = localised(sub_mesh, cut.mesh.vertices);
    const Points other = other_copy(positions);
    positions.topRows(sub_mesh.n_vertices).col(0).setConstant(4.0);
    robin->begin_step(positions, other, ventcell_time_step, ventcell_p);
    for (Index i = 0; i < sub_mesh.interface.size(); ++i)
        CHECK(robin->right_hand_side(i, positions, other) == other.row(sub_mesh.interface.vertices[i]));
}
