#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "partition/metrics/exact_crossing.h"
#include "partition/metrics/triangle_crossing.h"
#include "samples/meshes/random_numbers.h"

using namespace seamflow;

namespace {

const TriangleCorners flat{Point(0, 0, 0), Point(4, 0, 0), Point(0, 4, 0)};

/// Whatever the order of triangles and corners, and however large and where they are.
bool cross_somehow(const TriangleCorners& a, const TriangleCorners& b)
{
    const bool result = cross(a, b);
    TriangleCorners turned = b;
    do {
        CHECK(cross(a, turned) == result);
        CHECK(cross(turned, a) == result);
    } while (std::ranges::next_permutation(turned, [](const Point& p, const Point& q) {
                 return std::ranges::lexicographical_compare(p, q);
             }).found);
    for (const double scale : {0x1p-100, 0x1p-40, 0x1p90}) {
        const auto scaled = [&](const TriangleCorners& t) {
            return TriangleCorners{t[0] * scale, t[1] * scale, t[2] * scale};
        };
        CHECK(cross(scaled(a), scaled(b)) == result);
    }
    for (const Point& by : {Point(1024, -512, 64), Point(-0x1p30, 0x1p20, 3)}) {
        const auto moved = [&](const TriangleCorners& t) { return TriangleCorners{t[0] + by, t[1] + by, t[2] + by}; };
        CHECK(cross(moved(a), moved(b)) == result);
    }
    return result;
}

/// By exact predicates alone.
bool cross_exactly(TriangleCorners a, TriangleCorners b)
{
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
            same != b.end()) {
            std::swap(*same, b[shared]);
            std::swap(a[i], a[shared++]);
        }
    if (exact::is_flat(a) || exact::is_flat(b))
        return false;
    return shared == 0   ? exact::meet(a, b)
           : shared == 1 ? exact::meet_beyond_corner(a, b)
           : shared == 2 ? exact::meet_beyond_edge(a, b)
                         : true;
}

/// Whether a plane separates two triangles: normal to one of these axes if any does. For numbers that are so short that
/// doubles are exact.
bool are_separated(const TriangleCorners& a, const TriangleCorners& b)
{
    const auto edges = [](const TriangleCorners& t) { return TriangleCorners{t[1] - t[0], t[2] - t[1], t[0] - t[2]}; };
    std::vector<Point> axes{edges(a)[0].cross(edges(a)[1]), edges(b)[0].cross(edges(b)[1])};
    const std::array normals{axes[0], axes[1]};
    for (const Point& e : edges(a))
        for (const Point& g : edges(b))
            axes.insert(axes.end(), {e.cross(g), e.cross(normals[0]), g.cross(normals[1])});
    return std::ranges::any_of(axes, [&](const Point& axis) {
        const auto [low_a, high_a] = std::minmax({axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2])});
        const auto [low_b, high_b] = std::minmax({axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2])});
        return high_a < low_b || high_b < low_a;
    });
}

}  // namespace

TEST_CASE("triangles cross where one pierces the other, and not where they pass each other by")
{
    CHECK(cross_somehow(flat, {Point(1, 1, -1), Point(1, 1, 1), Point(2, 1, 1)}));
    CHECK(cross_somehow(flat, {Point(1, 1, -1), Point(2, 2, 1), Point(8, 1, 1)}));
    CHECK_FALSE(cross_somehow(flat, {Point(3, 3, -1), Point(3, 3, 1), Point(4, 3, 1)}));
    CHECK_FALSE(cross_somehow(flat, {Point(1, 1, 1), Point(2, 1, 1), Point(1, 2, 2)}));
    CHECK_FALSE(cross_somehow(flat, {Point(5, 0, 0), Point(9, 0, 0), Point(5, 4, 0)}));
}

TEST_CASE("triangles without a common corner cross where they touch, to the last bit")
{
    const double beside = std::nextafter(4.0, 5.0);
    // A corner on a face, on an edge, and an edge on an edge.
    CHECK(cross_somehow(flat, {Point(1, 1, 0), Point(1, 1, 4), Point(2, 1, 4)}));
    CHECK(cross_somehow(flat, {Point(2, 2, 0), Point(4, 4, 0), Point(4, 3, 0)}));
    CHECK(cross_somehow(flat, {Point(1, 0, 0), Point(3, 0, 0), Point(2, -1, 0)}));
    CHECK(cross_somehow(flat, {Point(2, -1, -1), Point(2, -1, 1), Point(2, 3, 1)}));
    CHECK_FALSE(cross(flat, {Point(beside, 0, 0), Point(8, 0, 0), Point(8, 1, 0)}));
    CHECK_FALSE(cross(flat, {Point(1, 1, 0x1p-1000), Point(1, 1, 4), Point(2, 1, 4)}));
}

TEST_CASE("triangles in one plane cross where they overlap")
{
    CHECK(cross_somehow(flat, {Point(1, 1, 0), Point(2, 1, 0), Point(1, 2, 0)}));
    CHECK(cross_somehow(flat, {Point(3, -1, 0), Point(3, 5, 0), Point(5, 2, 0)}));
    CHECK(cross_somehow(flat, flat));
}

TEST_CASE("triangles that share a corner cross where the opposite edge of one meets the other")
{
    CHECK(cross_somehow(flat, {Point(0, 0, 0), Point(2, 1, -1), Point(1, 2, 1)}));
    CHECK(cross_somehow(flat, {Point(0, 0, 0), Point(2, 1, 0), Point(1, 8, 0)}));
    CHECK(cross_somehow(flat, {Point(0, 0, 0), Point(2, 0, 0), Point(2, -1, 0)}));
    CHECK_FALSE(cross_somehow(flat, {Point(0, 0, 0), Point(-2, -1, -1), Point(-1, -2, 1)}));
    CHECK_FALSE(cross_somehow(flat, {Point(0, 0, 0), Point(-1, 1, 0), Point(-2, 1, 0)}));
    CHECK_FALSE(cross_somehow(flat, {Point(0, 0, 0), Point(1, 1, 1), Point(2, 1, 1)}));
    // The zeros of a position may have either sign.
    CHECK_FALSE(cross_somehow(flat, {Point(-0.0, 0, -0.0), Point(1, 1, 1), Point(2, 1, 1)}));
}

TEST_CASE("triangles that share an edge cross where they are folded onto each other")
{
    CHECK(cross_somehow(flat, {Point(0, 0, 0), Point(4, 0, 0), Point(1, 1, 0)}));
    CHECK(cross_somehow(flat, {Point(4, 0, 0), Point(0, 0, 0), Point(9, 9, 0)}));
    CHECK_FALSE(cross_somehow(flat, {Point(0, 0, 0), Point(4, 0, 0), Point(1, -1, 0)}));
    CHECK_FALSE(cross_somehow(flat, {Point(0, 0, 0), Point(4, 0, 0), Point(1, 0, 1)}));
    CHECK_FALSE(cross(flat, {Point(0, 0, 0), Point(4, 0, 0), Point(1, 1, 0x1p-1000)}));
}

TEST_CASE("triangles without area cross nothing")
{
    CHECK_FALSE(cross_somehow(flat, {Point(1, 1, -1), Point(1, 1, 1), Point(1, 1, 2)}));
    CHECK_FALSE(cross_somehow(flat, {Point(1, 1, 0), Point(1, 1, 0), Point(1, 1, 0)}));
    CHECK_FALSE(cross_somehow(flat, {Point(0, 0, 0), Point(4, 0, 0), Point(2, 0, 0)}));
    CHECK_FALSE(
        cross({Point(0, 0, 0), Point(1, 0, 0), Point(2, 0, 0)}, {Point(0, 0, 0), Point(2, 0, 0), Point(1, 0, 0)}));
}

TEST_CASE("exact triangles meet where no plane separates them, of whatever size they are and however sheared")
{
    RandomNumbers random(5);
    std::array<int, 2> n{};
    for (int i = 0; i < 4000; ++i) {
        std::array<TriangleCorners, 2> t;
        for (TriangleCorners& corners : t)
            for (Point& p : corners)
                p = Point(random.below(5) - 2, random.below(5) - 2, random.below(3) - 1);
        if (exact::is_flat(t[0]) || exact::is_flat(t[1])) {
            CHECK((t[0][1] - t[0][0]).cross(t[0][2] - t[0][0]).isZero(0.0) == exact::is_flat(t[0]));
            continue;
        }
        const bool are_apart = are_separated(t[0], t[1]);
        CHECK(exact::meet(t[0], t[1]) == !are_apart);
        ++n[are_apart ? 1 : 0];
        for (const double scale : {0x1p-1074, 0x1p-600, 0x1p500, 0x1p1018}) {
            std::array<TriangleCorners, 2> sheared = t;
            for (TriangleCorners& corners : sheared)
                for (Point& p : corners)
                    p = scale * Point(p[0] + 2 * p[1], p[1] - 3 * p[2], p[2] + p[0]);
            CHECK(exact::meet(sheared[0], sheared[1]) == !are_apart);
        }
    }
    CHECK(std::ranges::min(n) > 1000);
}

TEST_CASE("numbers of any size decide as exact ones do")
{
    // Few values: corners in common, in line, and planes in common are frequent.
    for (const double scale : {1e-320, 1e-200, 1e-90, 0.3, 1e70, 1e150, 5e307}) {
        RandomNumbers random(7);
        int n_crossing = 0;
        for (int i = 0; i < 3000; ++i) {
            std::array<TriangleCorners, 2> t;
            for (TriangleCorners& corners : t)
                for (Point& p : corners)
                    p = scale * Point(random.below(4) - 1.5, random.below(4) - 1.5, random.below(3) - 1);
            CHECK(cross(t[0], t[1]) == cross_exactly(t[0], t[1]));
            n_crossing += cross(t[0], t[1]) ? 1 : 0;
        }
        CHECK(n_crossing > 500);
    }
}

TEST_CASE("triangles that nearly touch decide as exact numbers do")
{
    RandomNumbers random(11);
    const auto point = [&] { return Point(random.symmetric(), random.symmetric(), random.symmetric()); };
    for (int i = 0; i < 20000; ++i) {
        const TriangleCorners a{point(), point(), point()};
        const double s = random.unit();
        const double t = random.unit() * (1.0 - s);
        // Some corners are those of the first triangle, or rounded from places on it.
        const auto near = [&]() -> Point { return a[0] + s * (a[1] - a[0]) + t * (a[2] - a[0]); };
        const Point other = random.below(2) == 0 ? near() : point();
        const TriangleCorners b{random.below(2) == 0 ? a[2] : near(), random.below(3) == 0 ? a[0] : other, point()};
        CHECK(cross(a, b) == cross_exactly(a, b));
    }
}
