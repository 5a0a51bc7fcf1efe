#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "tests/support/mesh_files.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

/// Each with its corners in ascending order.
std::set<Triangle> triangles_of(std::vector<Index> corners, const Points& positions)
{
    std::vector<Triangle> triangles;
    triangulate(corners, positions, triangles);
    CHECK(triangles.size() == corners.size() - 2);
    for (Triangle& t : triangles)
        std::ranges::sort(t);
    return {triangles.begin(), triangles.end()};
}

std::vector<Index> in_order(Index n)
{
    std::vector<Index> corners(n);
    for (Index k = 0; k < n; ++k)
        corners[k] = k;
    return corners;
}

double sum_of_areas(const std::set<Triangle>& triangles, const Points& positions)
{
    double sum = 0.0;
    for (const Triangle& t : triangles)
        sum += vector_area(t, positions).norm();
    return sum;
}

/// A star of n tips, a polygon of 2n corners, in an oblique plane.
Points star(Index n)
{
    Points points(2 * n, 3);
    for (Index k = 0; k < 2 * n; ++k) {
        const double angle = std::numbers::pi * k / n;
        const double radius = (k % 2 == 0 ? 1.0 : 0.3) * (1.0 + 0.01 * k);
        points.row(k) << radius * std::cos(angle), radius * std::sin(angle), 0.5 * radius * std::cos(angle) + 7.0;
    }
    return points;
}

}  // namespace

TEST_CASE("a quad is divided along its shorter diagonal")
{
    const Points kite{{0.0, 0.0, 0.0}, {2.0, -1.0, 0.0}, {5.0, 0.0, 1.0}, {2.0, 1.0, 0.0}};
    CHECK(triangles_of({0, 1, 2, 3}, kite) == std::set<Triangle>{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("a quad that is not convex is divided where its inside is")
{
    // The shorter diagonal, from 0 to 2, lies outside.
    const Points dart{{0.0, 0.0, 0.0}, {3.0, -4.0, 0.0}, {1.0, 0.0, 0.0}, {3.0, 4.0, 0.0}};
    CHECK(triangles_of({0, 1, 2, 3}, dart) == std::set<Triangle>{{0, 1, 2}, {0, 2, 3}});
    const Points arrow{{0.0, 0.0, 0.0}, {9.0, -1.0, 0.0}, {8.0, 0.0, 0.0}, {9.0, 1.0, 0.0}};
    CHECK(triangles_of({0, 1, 2, 3}, arrow) == std::set<Triangle>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("triangles of a planar polygon that is not convex cover it and nothing else")
{
    for (const Index tips : {3, 5, 12}) {
        const Points points = star(tips);
        const auto corners = in_order(2 * tips);
        CHECK(sum_of_areas(triangles_of(corners, points), points) ==
              test::relative(vector_area(corners, points).norm(), 1e-12));
    }
}

TEST_CASE("straight angles and corners in one place are no hindrance")
{
    const Points square{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {2.0, 1.0, 0.0},
                        {2.0, 2.0, 0.0}, {1.0, 2.0, 0.0}, {0.0, 2.0, 0.0}, {0.0, 1.0, 0.0}};
    CHECK(sum_of_areas(triangles_of(in_order(8), square), square) == test::relative(4.0, 1e-5));
    // A square with a square hole, cut open along a line that is run along twice.
    const Points keyhole{{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 4.0, 0.0}, {0.0, 4.0, 0.0}, {0.0, 0.0, 0.0},
                         {1.0, 1.0, 0.0}, {1.0, 3.0, 0.0}, {3.0, 3.0, 0.0}, {3.0, 1.0, 0.0}, {1.0, 1.0, 0.0}};
    CHECK(sum_of_areas(triangles_of(in_order(10), keyhole), keyhole) == test::relative(12.0, 1e-5));
}

TEST_CASE("no triangle has another corner on its border where there are others")
{
    // The fifth corner comes down to the middle of the line from the first to the third, the shortest diagonal.
    const Points notched{{0.0, 0.0, 0.0}, {0.5, -0.5, 0.0}, {1.0, 0.0, 0.0},  {3.0, 3.0, 0.0},
                         {2.0, 3.0, 0.0}, {0.5, 0.0, 0.0},  {-1.0, 3.0, 0.0}, {-2.0, 3.0, 0.0}};
    for (const Triangle& t : triangles_of(in_order(8), notched))
        CHECK(vector_area(t, notched).norm() > 0.1);
}

TEST_CASE("polygons without area or sense are covered, too")
{
    CHECK(triangles_of(in_order(6), Points::Zero(6, 3)).size() == 4);
    Points line = Points::Zero(7, 3);
    line.col(1) = Eigen::VectorXd::LinSpaced(7, 0.0, 3.0);
    CHECK(triangles_of(in_order(7), line).size() == 5);
    const Points bow{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    CHECK(triangles_of(in_order(4), bow).size() == 2);
}

TEST_CASE("neither the first corner nor the sense of a polygon matters")
{
    const PolygonMesh mesh = make_mixed_polygons(900);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        std::vector<Index> corners(mesh.face(f).begin(), mesh.face(f).end());
        const auto expected = triangles_of(corners, mesh.vertices);
        std::rotate(corners.begin(), corners.begin() + f % static_cast<Index>(corners.size()), corners.end());
        CHECK(triangles_of(corners, mesh.vertices) == expected);
        std::reverse(corners.begin(), corners.end());
        CHECK(triangles_of(corners, mesh.vertices) == expected);
    }
}

TEST_CASE("a polygon of many corners takes no noticeable time")
{
    const Index n = 2000;
    const Points points = star(n / 2);
    CHECK(sum_of_areas(triangles_of(in_order(n), points), points) ==
          test::relative(vector_area(in_order(n), points).norm(), 1e-9));
}
