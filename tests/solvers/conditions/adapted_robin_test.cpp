#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

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
    for_each_sub_mesh([&](const CutMesh& cut, const SubMesh& sub_mesh) {
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
            const Point v = positions.row(sub_mesh.interface.vertices[i]);
            const Point right = row_of(condition, i, positions, row);
            normal_derivative_row(sub_mesh, stencils, i, *own, normal);
            CHECK((right - (v - dt_p * other->direction)).norm() < 1e-14 * (1.0 + v.norm()));
            const auto centre = usize(stencils.centre[i]);
            for (std::size_t k = 0; k < row.size(); ++k)
                CHECK(row[k] == dt_p * normal[k] + (k == centre ? 1.0 : 0.0));
        }
    });
}

namespace {

/// A flat mesh of unit squares around the origin, cut along the y axis, whose vertices are moved, and whether the
/// condition is well defined at the origin.
class Crossing {
  public:
    /// Where the vertex at (x, y) goes. What is done to the vertices with x < 0 is done to one side alone.
    using Move = std::function<Point(double x, double y)>;

    Crossing()
        : cut_(cut_by_place("", centred(), [](const Point& c) { return c.x() > 0.0 ? Index{1} : Index{0}; }))
        , decomposition_(test::decompose(cut_))
    {
    }

    /// @param s 0: the side that is moved is the sub-mesh's own; 1: it is the other.
    [[nodiscard]] bool is_well_defined(Index s, const Move& move) const
    {
        const SubMesh& sub_mesh = decomposition_.sub_meshes[s];
        Points positions = localised(sub_mesh, cut_.mesh.vertices);
        const auto& vertices = sub_mesh.interface.vertices;
        const auto origin =
            std::ranges::find_if(vertices, [&](Index v) { return positions.row(v).norm() == 0.0; }) - vertices.begin();
        REQUIRE(origin < sub_mesh.interface.size());
        for (Eigen::Index v = 0; v < positions.rows(); ++v)
            positions.row(v) = move(positions(v, 0), positions(v, 1));
        AdaptedRobin condition(sub_mesh);
        condition.begin_step(positions, positions, 1.0, 1.0);
        return condition.is_well_defined(static_cast<Index>(origin), positions);
    }

  private:
    static PolygonMesh centred()
    {
        PolygonMesh mesh = quad_grid(4, 4);
        mesh.vertices.leftCols(2).array() -= 2.0;
        return mesh;
    }

    CutMesh cut_;
    Decomposition decomposition_;
};

/// Moves the corners beyond the origin of the two squares with x < 0 at it, to both sides of the x axis.
Crossing::Move corners_to(double to_x, double shift_y)
{
    return [=](double x, double y) { return x == -1.0 && y != 0.0 ? Point(to_x, y + shift_y, 0.0) : Point(x, y, 0.0); };
}

}  // namespace

TEST_CASE("on either side, each of the criteria alone tells where the condition is not well defined")
{
    const Crossing crossing;
    const auto turned = [](double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        return [=](double x, double y) {
            return x < 0.0 ? Point(-std::cos(angle) * x, y, std::sin(angle) * x) : Point(x, y, 0.0);
        };
    };
    const auto pinched = [](double length) {
        return [=](double x, double y) { return Point(x, x == 0.0 ? length * y : y, 0.0); };
    };
    for (const Index s : {0, 1}) {
        CAPTURE(s);
        CHECK(crossing.is_well_defined(s, [](double x, double y) { return Point(x, y, 0.0); }));
        // A side without a conormal.
        CHECK_FALSE(crossing.is_well_defined(s, [](double x, double y) { return Point(std::max(x, 0.0), y, 0.0); }));
        // Conormals at an angle of 120 degrees are the limit.
        CHECK(crossing.is_well_defined(s, turned(125.0)));
        CHECK_FALSE(crossing.is_well_defined(s, turned(115.0)));
        // The neighbours on Γ, 2 t apart, against mean edges of (2 + 2 t) / 4.
        CHECK(crossing.is_well_defined(s, pinched(0.09)));
        CHECK_FALSE(crossing.is_well_defined(s, pinched(0.07)));
        // The diagonal of ∂n is 3 / (1 - x), where edges have length 1: too little beyond 0.2.
        CHECK(crossing.is_well_defined(s, corners_to(-13.5, 0.0)));
        CHECK_FALSE(crossing.is_well_defined(s, corners_to(-14.5, 0.0)));
        // And too much beyond 6.
        CHECK(crossing.is_well_defined(s, corners_to(0.47, 0.0)));
        CHECK_FALSE(crossing.is_well_defined(s, corners_to(0.53, 0.0)));
        // So are the coefficients along Γ, 1 + shift / 4.
        CHECK(crossing.is_well_defined(s, corners_to(-1.0, 19.0)));
        CHECK_FALSE(crossing.is_well_defined(s, corners_to(-1.0, 21.0)));
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
            CHECK(right == positions.row(sub_mesh.interface.vertices[i]));
            for (std::size_t k = 0; k < row.size(); ++k)
                CHECK(row[k] == (k == usize(stencils.centre[i]) ? 1.0 : 0.0));
        }
    };
    check_stays(flat, 0.0);
    check_stays(own_gone, 0.5);
    check_stays(other_gone, 0.5);
}
