#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <doctest/doctest.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/metrics/surface_distance.h"
#include "partition/metrics/triangulation.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "tests/support/mesh_files.h"
#include "tests/support/relative.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

using Precise = Eigen::Matrix<long double, 1, 3>;

long double to_segment(const Precise& p, const Precise& a, const Precise& b)
{
    const Precise u = b - a;
    const long double uu = u.squaredNorm();
    long double s = uu > 0.0L ? (p - a).dot(u) / uu : 0.0L;
    s = std::min(std::max(s, 0.0L), 1.0L);
    return (p - a - s * u).norm();
}

/// With more digits than the tree has, and by another way: the side of each edge on which the foot lies.
long double to_triangle(const Precise& p, const Precise& a, const Precise& b, const Precise& c)
{
    const long double borders = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
    const Precise n = (b - a).cross(c - a);
    if (n.squaredNorm() <= 0.0L)
        return borders;
    const bool inside = n.dot((b - a).cross(p - a)) >= 0.0L && n.dot((c - b).cross(p - b)) >= 0.0L &&
                        n.dot((a - c).cross(p - c)) >= 0.0L;
    return inside ? std::min(borders, std::abs(n.dot(p - a)) / n.norm()) : borders;
}

double brute_force(const Point& p, const PolygonMesh& surface)
{
    long double least = std::numeric_limits<long double>::infinity();
    const auto corner = [&](Index v) -> Precise { return surface.vertices.row(v).cast<long double>(); };
    for (const auto& [a, b, c] : triangulate(surface))
        least = std::min(least, to_triangle(p.cast<long double>(), corner(a), corner(b), corner(c)));
    return static_cast<double>(least);
}

Points random_points(Index n, std::mt19937& random)
{
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    return Points::NullaryExpr(n, 3, [&] { return unit(random); });
}

/// Polygons of 3 to 7 corners anywhere: most of them neither planar nor simple.
PolygonMesh polygon_soup(Index faces, std::mt19937& random)
{
    PolygonMesh mesh;
    for (Index f = 0; f < faces; ++f) {
        std::vector<Index> corners(3 + random() % 5);
        for (std::size_t k = 0; k < corners.size(); ++k)
            corners[k] = mesh.n_corners() + static_cast<Index>(k);
        mesh.add_face(corners);
    }
    mesh.vertices = random_points(mesh.n_corners(), random);
    return mesh;
}

void check_against_brute_force(const PolygonMesh& surface, const Points& points)
{
    const auto distances = SurfaceDistance(surface)(points);
    REQUIRE(distances.size() == static_cast<std::size_t>(points.rows()));
    for (Index v = 0; v < points.rows(); ++v)
        CHECK(distances[v] == test::relative(brute_force(points.row(v), surface), 1e-9));
}

PolygonMesh moved(PolygonMesh mesh, const Point& by)
{
    mesh.vertices.rowwise() += by;
    return mesh;
}

/// Of p from the triangle (0, 0, 0), (4, 0, 0), (0, 4, 0).
double from_corner_triangle(const Point& p)
{
    return std::sqrt(squared_distance_to_triangle(-p, Point(4.0, 0.0, 0.0) - p, Point(0.0, 4.0, 0.0) - p));
}

}  // namespace

TEST_CASE("distances are those of a search through all triangles")
{
    std::mt19937 random(1);
    for (const Index faces : {1, 2, 3, 4, 5, 17, 150})
        check_against_brute_force(polygon_soup(faces, random), 1.5 * random_points(60, random));
}

TEST_CASE("triangles without area count as what they are")
{
    std::mt19937 random(2);
    PolygonMesh mesh = polygon_soup(40, random);
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        const auto corners = mesh.face(f);
        if (f % 4 == 0)  // one place
            for (const Index v : corners)
                mesh.vertices.row(v) = mesh.vertices.row(corners[0]).eval();
        else if (f % 4 == 1)  // one line
            for (const Index v : corners)
                mesh.vertices.row(v) = mesh.vertices(v, 0) * Point(0.25, 0.5, -1.0);
        else if (f % 4 == 2)  // two corners in one place
            mesh.vertices.row(corners[1]) = mesh.vertices.row(corners[0]).eval();
    }
    check_against_brute_force(mesh, random_points(100, random));
}

TEST_CASE("a surface of one point and one of one segment")
{
    PolygonMesh mesh = test::make_triangle();
    mesh.vertices.rowwise() = Point(1.0, 2.0, 3.0);
    const Points origin = Points::Zero(1, 3);
    CHECK(SurfaceDistance(mesh)(origin)[0] == test::relative(std::sqrt(14.0), 1e-5));
    mesh.vertices << 1.0, -1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 5.0, 0.0;
    CHECK(SurfaceDistance(mesh)(origin)[0] == 1.0);
}

TEST_CASE("thin triangles are as exact as others")
{
    std::mt19937 random(3);
    for (const double thickness : {1e-3, 1e-6, 1e-9, 1e-12}) {
        PolygonMesh mesh = polygon_soup(30, random);
        mesh.vertices.col(2) = 0.3 * mesh.vertices.col(0) + thickness * mesh.vertices.col(2);
        mesh.vertices.col(1) = 0.7 * mesh.vertices.col(0) + thickness * mesh.vertices.col(1);
        check_against_brute_force(mesh, random_points(50, random));
        check_against_brute_force(mesh, Points(mesh.vertices + 1e-3 * random_points(mesh.n_vertices(), random)));
    }
}

TEST_CASE("a large offset costs nothing")
{
    std::mt19937 random(4);
    const Point offset(1e6, -3e7, 2e5);
    const PolygonMesh mesh = moved(polygon_soup(80, random), offset);
    Points points = random_points(50, random);
    points.rowwise() += offset;
    check_against_brute_force(mesh, points);
    // Close to the surface, too: a point above the middle of a triangle by four units in the last place.
    const PolygonMesh triangle =
        test::make_mesh(Points{{1e6, 1e6, 1e6}, {1e6 + 3.0, 1e6, 1e6}, {1e6, 1e6 + 3.0, 1e6}}, {{0, 1, 2}});
    const double height = 0x1p-31;
    CHECK(SurfaceDistance(triangle)(Points{{1e6 + 1.0, 1e6 + 1.0, 1e6 + height}})[0] == height);
}

TEST_CASE("vertices lie on their own surface")
{
    for (const test::NamedMesh& named : test::assorted_meshes()) {
        CAPTURE(named.name);
        if (named.mesh.n_faces() > 0)
            CHECK(surface_distance(named.mesh, named.mesh).max == 0.0);
    }
}

TEST_CASE("a plane moved by h is at distance h, in the middle of its faces, too")
{
    const PolygonMesh plane = test::hexagon_sheet(9, 7);
    for (const double h : {1e-9, 0.25, 3.0}) {
        const LengthStatistics distance = surface_distance(plane, moved(plane, Point(0.0, 0.0, h)));
        CHECK(distance.mean == test::relative(h, 1e-12));
        CHECK(distance.rms == test::relative(h, 1e-12));
        CHECK(distance.max == test::relative(h, 1e-12));
    }
    // Within its plane only the vertices at the rim leave the surface.
    const PolygonMesh grid = test::quad_grid(20, 20);
    const LengthStatistics sideways = surface_distance(moved(grid, Point(0.5, 0.0, 0.0)), grid);
    CHECK(sideways.max == test::relative(0.5, 1e-5));
    CHECK(sideways.mean == test::relative(0.5 / 21.0, 1e-5));
}

TEST_CASE("the two directions differ, the larger of both does not")
{
    const PolygonMesh small = test::quad_grid(2, 2);
    const PolygonMesh large = test::quad_grid(5, 2);
    CHECK(surface_distance(small, large).max == 0.0);
    CHECK(surface_distance(large, small).max == 3.0);
    const LengthStatistics larger = larger_of({1.0, 2.0, 9.0}, {3.0, 1.0, 8.0});
    CHECK(larger.mean == 3.0);
    CHECK(larger.rms == 2.0);
    CHECK(larger.max == 9.0);
}

TEST_CASE("vertices without faces are no part of a surface")
{
    PolygonMesh mesh = test::quad_grid(3, 3);
    mesh.vertices.conservativeResize(mesh.n_vertices() + 1, 3);
    mesh.vertices.bottomRows(1) << 100.0, 100.0, 100.0;
    CHECK(surface_distance(mesh, test::quad_grid(3, 3)).max == 0.0);
    CHECK(surface_distance(test::quad_grid(3, 3), mesh).max == 0.0);
    const PolygonMesh points = test::make_mesh(Points::Random(4, 3), {});
    CHECK_THROWS_AS(surface_distance(points, mesh), InputError);
    CHECK_THROWS_AS(surface_distance(mesh, points), InputError);
}

TEST_CASE("a generated mesh of polygons against another")
{
    const PolygonMesh mixed = make_mixed_polygons(400);
    const PolygonMesh hexagons = make_hexagons(300);
    check_against_brute_force(mixed, hexagons.vertices);
    check_against_brute_force(hexagons, mixed.vertices);
}

TEST_CASE("distance of a point over the inside, the edges and the corners of a triangle")
{
    CHECK(from_corner_triangle({1.0, 1.0, 3.0}) == 3.0);
    CHECK(from_corner_triangle({1.0, 1.0, 0.0}) == 0.0);
    CHECK(from_corner_triangle({2.0, -3.0, 4.0}) == 5.0);
    CHECK(from_corner_triangle({-3.0, 2.0, -4.0}) == 5.0);
    CHECK(from_corner_triangle({4.0, 4.0, 0.0}) == test::relative(std::sqrt(8.0), 1e-5));
    CHECK(from_corner_triangle({-3.0, -4.0, 0.0}) == 5.0);
    CHECK(from_corner_triangle({7.0, 0.0, 4.0}) == 5.0);
    CHECK(from_corner_triangle({4.0, 0.0, 0.0}) == 0.0);
}

TEST_CASE("triangles that are segments or points")
{
    const Point a(1.0, 0.0, 0.0);
    const Point b(1.0, 2.0, 0.0);
    const Point c(1.0, -2.0, 0.0);
    CHECK(squared_distance_to_triangle(a, a, a) == 1.0);
    CHECK(squared_distance_to_triangle(b, b, b) == 5.0);
    CHECK(squared_distance_to_triangle(b, c, b) == 1.0);
    CHECK(squared_distance_to_triangle(b, b, c) == 1.0);
    CHECK(squared_distance_to_triangle(a, b, c) == 1.0);
    CHECK(squared_distance_to_triangle(a, b, b) == 1.0);
}

TEST_CASE("a point in the middle of a sliver lies on it")
{
    for (const double height : {1e-4, 1e-7, 1e-9}) {
        const Point a(-1.0, -0.3, 0.2);
        const Point b(1.0, 0.3, -0.2);
        const Point c(0.3 * b + height * Point(0.2, 0.1, 1.0));
        const Point middle = (a + b + c) / 3.0;
        CHECK(squared_distance_to_triangle(a - middle, b - middle, c - middle) < 1e-30);
    }
}

TEST_CASE("points from which all faces are about as far away")
{
    const PolygonMesh sphere = make_noisy_sphere(350, {.noise = 0.0});
    const PolygonMesh rings = make_cylinder(350, {.noise = 0.0});
    for (const PolygonMesh& surface : {sphere, rings})
        for (const double scale : {0.3, 0.01, 0.0}) {
            const Point middle = surface.vertices.colwise().mean();
            Points points = scale * (surface.vertices.rowwise() - middle);
            points.rowwise() += middle;
            check_against_brute_force(surface, points);
            CHECK(SurfaceDistance(surface)(points, run_in_parallel) == SurfaceDistance(surface)(points));
        }
}

TEST_CASE("faces that all meet in one vertex, and points between them")
{
    std::mt19937 random(6);
    PolygonMesh fan;
    constexpr Index n = 700;
    fan.vertices = random_points(n + 1, random);
    fan.vertices.col(2) *= 1e-3;
    for (Index i = 0; i + 1 < n; ++i)
        fan.add_face(std::array<Index, 3>{n, i, i + 1});
    check_against_brute_force(fan, random_points(300, random));
}
