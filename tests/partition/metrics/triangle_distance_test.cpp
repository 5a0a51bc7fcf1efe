#include <cmath>

#include <doctest/doctest.h>

#include "partition/metrics/triangle_distance.h"

using namespace seamflow;

namespace {

/// Of p from the triangle (0, 0, 0), (4, 0, 0), (0, 4, 0).
double from_corner_triangle(const Point& p)
{
    return std::sqrt(squared_distance_to_triangle(-p, Point(4.0, 0.0, 0.0) - p, Point(0.0, 4.0, 0.0) - p));
}

}  // namespace

TEST_CASE("distance of a point over the inside, the edges and the corners of a triangle")
{
    CHECK(from_corner_triangle({1.0, 1.0, 3.0}) == 3.0);
    CHECK(from_corner_triangle({1.0, 1.0, 0.0}) == 0.0);
    CHECK(from_corner_triangle({2.0, -3.0, 4.0}) == 5.0);
    CHECK(from_corner_triangle({-3.0, 2.0, -4.0}) == 5.0);
    CHECK(from_corner_triangle({4.0, 4.0, 0.0}) == doctest::Approx(std::sqrt(8.0)));
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
