#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "solvers/conditions/robin_parameter.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

/// The paper's formula.
double closed_formula(double width, double shortest_edge)
{
    const double k_min = std::numbers::pi / width;
    const double k_max = std::numbers::pi / shortest_edge;
    return std::pow((k_min * k_min + 1.0) * (k_max * k_max + 1.0), 0.25);
}

/// A grid of m by n cells of size h by tall, cut in two strips behind the cell `cut`.
CutMesh two_strips(Index m, Index n, Index cut, double h, double tall)
{
    PolygonMesh mesh = quad_grid(m, n);
    mesh.vertices.col(0) *= h;
    mesh.vertices.col(1) *= tall;
    return cut_by_place("", mesh, [=](const Point& c) { return c.x() > h * cut ? Index{1} : Index{0}; });
}

double parameter(const CutMesh& cut, Index s)
{
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes[s];
    return optimal_robin_parameter(sub_mesh, localised(sub_mesh, cut.mesh.vertices));
}

}  // namespace

TEST_CASE("p* of a strip is the closed formula of its width and its shortest edge")
{
    // The interface ends one edge before the boundary: the corners are that much farther away.
    CHECK(parameter(two_strips(10, 4, 4, 1.0, 1.0), 0) == relative(closed_formula(5.0, 1.0), 1e-5));
    CHECK(parameter(two_strips(10, 4, 4, 1.0, 1.0), 1) == relative(closed_formula(7.0, 1.0), 1e-5));
    CHECK(parameter(two_strips(12, 5, 3, 0.5, 0.125), 0) == relative(closed_formula(1.625, 0.125), 1e-5));
    CHECK(parameter(two_strips(12, 5, 3, 0.125, 0.5), 1) == relative(closed_formula(1.625, 0.125), 1e-5));
}

TEST_CASE("p* of a piece of a tube is the closed formula of its length")
{
    PolygonMesh mesh = cylinder(8, 9);
    const double around = 2.0 * std::sin(std::numbers::pi / 8.0);
    const CutMesh cut = cut_by_place("", mesh, [](const Point& c) { return c.z() > 3.0 ? Index{1} : Index{0}; });
    CHECK(parameter(cut, 0) == relative(closed_formula(3.0, around), 1e-5));
    CHECK(parameter(cut, 1) == relative(closed_formula(6.0, around), 1e-5));
    mesh.vertices.col(2) *= 0.25;
    const CutMesh low = cut_by_place("", mesh, [](const Point& c) { return c.z() > 0.75 ? Index{1} : Index{0}; });
    CHECK(parameter(low, 1) == relative(closed_formula(1.5, 0.25), 1e-5));
}

TEST_CASE("without an interface p* is 0")
{
    const PolygonMesh mesh = quad_grid(5, 5);
    const Topology topology = make_topology(mesh);
    const Decomposition whole = seamflow::decompose(mesh, topology, std::vector<Index>(25, 0), 1);
    CHECK(optimal_robin_parameter(whole.sub_meshes.front(), mesh.vertices) == 0.0);
}

TEST_CASE("where every vertex lies on the interface the width is the shortest edge")
{
    const CutMesh cut = cut_by_place("", quad_grid(3, 3), [](const Point& c) {
        return (c - Point(1.5, 1.5, 0)).norm() < 0.5 ? Index{1} : Index{0};
    });
    CHECK(parameter(cut, 1) == relative(closed_formula(1.0, 1.0), 1e-5));
}

TEST_CASE("edges without length do not count")
{
    CutMesh cut = two_strips(10, 4, 4, 1.0, 1.0);
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes.front();
    Points positions = localised(sub_mesh, cut.mesh.vertices);
    positions.row(local_index(sub_mesh, 12)) = positions.row(local_index(sub_mesh, 11));
    CHECK(optimal_robin_parameter(sub_mesh, positions) == relative(closed_formula(5.0, 1.0), 1e-5));
    positions.setZero();
    CHECK(optimal_robin_parameter(sub_mesh, positions) == 0.0);
}

TEST_CASE("the automatic edge is the shortest one, unless that belongs to a sliver")
{
    const CutMesh cut = two_strips(20, 10, 8, 1.0, 1.0);
    const Decomposition decomposition = test::decompose(cut);
    const SubMesh& sub_mesh = decomposition.sub_meshes.front();
    const auto parameters = [&](double shift) {
        Points positions = localised(sub_mesh, cut.mesh.vertices);
        const Index moved = sub_mesh.face_vertices[0][0];
        const Index next = sub_mesh.face_vertices[0][1];
        positions.row(moved) += shift * (positions.row(next) - positions.row(moved));
        const auto with = [&](PEdge edge) { return optimal_robin_parameter(sub_mesh, positions, 1.0, edge); };
        return std::array{with(PEdge::Automatic), with(PEdge::Minimum), with(PEdge::Percentile)};
    };
    const auto in_proportion = parameters(0.8);
    CHECK(in_proportion[0] == in_proportion[1]);
    CHECK(in_proportion[1] > 1.5 * in_proportion[2]);
    const auto sliver = parameters(0.999);
    CHECK(sliver[0] == sliver[2]);
    CHECK(sliver[1] > 10.0 * sliver[2]);
}
