#include <doctest/doctest.h>

#include "solvers/conditions/adapted_robin.h"
#include "tests/support/conditions.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

CutMesh flat_halves()
{
    return cut_by_place("", quad_grid(8, 6), [](const Point& c) { return c.x() > 4.0 ? Index{1} : Index{0}; });
}

}  // namespace

TEST_CASE("the row is (I + dt p ∂n) and the right-hand side (I - dt p ∂n) of the other side")
{
    const double dt_p = 0.03;
    for (const CutMesh& cut : cut_meshes()) {
        CAPTURE(cut.name);
        const Decomposition decomposition = test::decompose(cut);
        for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
            const Points positions = localised(sub_mesh, cut.mesh.vertices);
            AdaptedRobin condition(sub_mesh);
            condition.begin_step(positions, positions, 1.0, dt_p);
            const DerivativeStencils& stencils = condition.stencils();
            for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
                const auto own = own_conormal(sub_mesh, i, positions);
                const auto other = complement_conormal(sub_mesh, i, positions);
                if (!own || !other)
                    continue;
                std::vector<double> row(stencils.columns[i].size());
                std::vector<double> normal(row.size());
                const Point v = positions.row(sub_mesh.interface.vertices[at(i)]);
                const Point right = row_of(condition, i, positions, row);
                normal_derivative_row(sub_mesh, stencils, i, *own, normal);
                CHECK((right - (v - dt_p * other->direction)).norm() < 1e-14 * (1.0 + v.norm()));
                const auto centre = at(stencils.centre[at(i)]);
                for (std::size_t k = 0; k < row.size(); ++k)
                    CHECK(row[k] == dt_p * normal[k] + (k == centre ? 1.0 : 0.0));
            }
        }
    }
}

TEST_CASE("a flat mesh with a straight interface satisfies the condition as it is")
{
    const CutMesh cut = flat_halves();
    const Decomposition decomposition = test::decompose(cut);
    for (const SubMesh& sub_mesh : decomposition.sub_meshes) {
        const Points positions = localised(sub_mesh, cut.mesh.vertices);
        AdaptedRobin condition(sub_mesh);
        condition.begin_step(positions, positions, 1.0, 0.7);
        const DerivativeStencils& stencils = condition.stencils();
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            CHECK(condition.is_well_defined(i, positions));
            std::vector<double> row(stencils.columns[i].size());
            const Point right = row_of(condition, i, positions, row);
            CHECK((applied(stencils.columns[i], row, positions) - right).norm() < 1e-13);
        }
    }
}

TEST_CASE("p = 0 and a missing conormal on either side leave the vertex where it is")
{
    const CutMesh cut = flat_halves();
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes.front();
    AdaptedRobin condition(sub_mesh);
    const DerivativeStencils& stencils = condition.stencils();
    const Points flat = localised(sub_mesh, cut.mesh.vertices);
    Points own_gone = flat;
    own_gone.topRows(sub_mesh.n_vertices).col(0).setConstant(4.0);
    Points other_gone = flat;
    other_gone.bottomRows(sub_mesh.n_halo).col(0).setConstant(4.0);
    const auto check_stays = [&](const Points& positions, double dt_p) {
        condition.begin_step(positions, positions, 1.0, dt_p);
        for (Index i = 0; i < sub_mesh.interface.size(); ++i) {
            std::vector<double> row(stencils.columns[i].size(), 99.0);
            const Point right = row_of(condition, i, positions, row);
            CHECK(right == positions.row(sub_mesh.interface.vertices[at(i)]));
            for (std::size_t k = 0; k < row.size(); ++k)
                CHECK(row[k] == (k == at(stencils.centre[at(i)]) ? 1.0 : 0.0));
        }
    };
    check_stays(flat, 0.0);
    check_stays(own_gone, 0.5);
    check_stays(other_gone, 0.5);
}
