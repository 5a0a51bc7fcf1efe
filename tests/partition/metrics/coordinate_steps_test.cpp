#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "partition/metrics/coordinate_steps.h"
#include "samples/meshes/random_numbers.h"
#include "tests/support/digitised.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using test::ball;
using test::voxel_faces;

namespace {

Point found_in(const Points& points, double length)
{
    const std::array<CoordinateSteps, 3> steps = find_coordinate_steps(points, length);
    return {steps[0].step, steps[1].step, steps[2].step};
}

/// Points at whole numbers of planes, 11 of them in each direction, times the steps.
Points lattice_points(const Point& steps)
{
    Points points(11 * 11 * 11, 3);
    for (Index v = 0; v < points.rows(); ++v)
        points.row(v) = Point(v % 11, v / 11 % 11, v / 121).cwiseProduct(steps);
    return points;
}

}  // namespace

TEST_CASE("steps of each coordinate are found, whatever their origin and scale")
{
    const Point steps(0.7, 0.7, 3.0);
    const Points points = lattice_points(steps);
    for (const double scale : {1.0, 1.0 / 3.0, 1e-6, 25.4e3})
        for (const Point& origin : {Point(0.0, 0.0, 0.0), Point(0.1, -17.3, 1e3)}) {
            CAPTURE(scale);
            CAPTURE(origin);
            const Points moved = scale * (points.rowwise() + origin);
            const std::array<CoordinateSteps, 3> found = find_coordinate_steps(moved, scale);
            for (int axis = 0; axis < 3; ++axis) {
                const CoordinateSteps& of_axis = found[static_cast<std::size_t>(axis)];
                REQUIRE(of_axis.step > 0.0);
                CHECK(std::abs(of_axis.step - scale * steps[axis]) < 1e-9 * scale);
                for (Index v = 0; v < moved.rows(); ++v)
                    CHECK(of_axis.has(moved(v, axis)));
                CHECK_FALSE(of_axis.has(moved(0, axis) + 0.4 * scale * steps[axis]));
            }
        }
}

TEST_CASE("steps are found in the digits of a file")
{
    const Points exact = lattice_points(Point(1.0 / 3.0, 0.1, 2.0 / 7.0));
    Points in_floats = (exact.rowwise() + Point(100.0, 100.0, 100.0)).cast<float>().cast<double>();
    CHECK((found_in(in_floats, 0.3) - Point(1.0 / 3.0, 0.1, 2.0 / 7.0)).cwiseAbs().maxCoeff() < 1e-4);
    const Points in_digits = exact.unaryExpr([](double x) { return std::round(1e5 * x) / 1e5; });
    CHECK((found_in(in_digits, 0.3) - Point(1.0 / 3.0, 0.1, 2.0 / 7.0)).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("some vertices may lie anywhere, also on a plane of their own")
{
    RandomNumbers random(5);
    for (const bool on_a_plane : {false, true}) {
        Points points = lattice_points(Point::Ones());
        for (Index v = 0; v < points.rows(); v += 8)
            points.row(v) = on_a_plane ? Point(3.37, points(v, 1), 7.71)
                                       : Point(10.0 * random.unit(), 10.0 * random.unit(), 10.0 * random.unit());
        CHECK((found_in(points, 1.0) - Point::Ones()).cwiseAbs().maxCoeff() < 1e-9);
    }
}

TEST_CASE("halves count where more than a few vertices have them")
{
    // Every vertex is at whole numbers in two coordinates and between two in the third.
    const PolygonMesh mesh = test::crossed_edges(ball(6.3), 17, Point(0.5, 0.5, 2.5));
    CHECK((found_in(mesh.vertices, 0.8) - Point(0.25, 0.25, 1.25)).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("there are no steps where values lie anywhere, are too near to each other, or are all equal")
{
    RandomNumbers random(7);
    Points points(3000, 3);
    for (Index v = 0; v < points.rows(); ++v)
        points.row(v) = Point(random.unit(), random.unit(), random.unit());
    CHECK(found_in(points, 0.05).isZero(0.0));
    CHECK(found_in(points, 1.0).isZero(0.0));
    CHECK(found_in(lattice_points(Point::Constant(1e-4)), 1.0).isZero(0.0));
    CHECK(found_in(Points::Ones(50, 3), 1.0).isZero(0.0));
    CHECK(found_in(Points(0, 3), 1.0).isZero(0.0));
    CHECK(found_in(lattice_points(Point::Ones()), 0.0).isZero(0.0));
    const PolygonMesh torus = test::triangle_torus(24, 12);
    CHECK(found_in(torus.vertices, 0.2).isZero(0.0));
}
