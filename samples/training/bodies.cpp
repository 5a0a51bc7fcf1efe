#include "samples/training/bodies.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "samples/training/draws.h"

namespace seamflow {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
/// Corners of what is to look round.
constexpr int circle_corners = 96;

/// Rings of equally many vertices, counter-clockwise seen from above, from the lowest to the highest. Fans around two
/// poles close the lowest and the highest ring; without poles, the highest ring is joined to the lowest.
Solid join_rings(const std::vector<Ring>& rings, const std::vector<Point>& poles)
{
    Solid solid;
    const std::size_t n = rings[0].size();
    for (const Ring& ring : rings)
        for (const Point& p : ring)
            solid.add_vertex(to_cgal(p));
    const auto vertex = [&](std::size_t ring, std::size_t k) {
        return Solid::Vertex_index(static_cast<Solid::size_type>(ring % rings.size() * n + k % n));
    };
    for (std::size_t i = 0; i + (poles.empty() ? 0 : 1) < rings.size(); ++i)
        for (std::size_t k = 0; k < n; ++k) {
            solid.add_face(vertex(i, k), vertex(i, k + 1), vertex(i + 1, k + 1));
            solid.add_face(vertex(i, k), vertex(i + 1, k + 1), vertex(i + 1, k));
        }
    if (poles.empty())
        return solid;
    const auto lowest = solid.add_vertex(to_cgal(poles[0]));
    const auto highest = solid.add_vertex(to_cgal(poles[1]));
    for (std::size_t k = 0; k < n; ++k) {
        solid.add_face(lowest, vertex(0, k + 1), vertex(0, k));
        solid.add_face(highest, vertex(rings.size() - 1, k), vertex(rings.size() - 1, k + 1));
    }
    return solid;
}

/// @param power_along, power_around 1: an ellipsoid; towards 0 it becomes a box (Barr, Superquadrics, 1981).
Solid make_ellipsoid(const Point& radii, double power_along = 1.0, double power_around = 1.0)
{
    const auto power = [](double x, double exponent) { return std::copysign(std::pow(std::abs(x), exponent), x); };
    std::vector<Ring> rings;
    for (int i = 1; i < circle_corners / 2; ++i) {
        const double latitude = std::numbers::pi * (2.0 * i / circle_corners - 0.5);
        const double width = power(std::cos(latitude), power_along);
        Ring& ring = rings.emplace_back();
        for (const Point& p : ellipse(circle_corners, 1.0, 1.0))
            ring.push_back(
                radii.cwiseProduct(Point(width * power(p.x(), power_around), width * power(p.y(), power_around),
                                         power(std::sin(latitude), power_along))));
    }
    return join_rings(rings, {Point(0.0, 0.0, -radii.z()), Point(0.0, 0.0, radii.z())});
}

Ring make_star(int n_points, double inner_radius)
{
    Ring ring = ellipse(2 * n_points, 0.9, 0.9);
    for (std::size_t k = 1; k < ring.size(); k += 2)
        ring[k] *= inner_radius;
    return ring;
}

}  // namespace

Ring ellipse(int n, double a, double b, double phase)
{
    Ring ring;
    for (int k = 0; k < n; ++k)
        ring.emplace_back(a * std::cos(phase + full_turn * k / n), b * std::sin(phase + full_turn * k / n), 0.0);
    return ring;
}

Solid make_prism(const Ring& polygon, double half_height, double taper)
{
    Ring low;
    Ring high;
    for (const Point& p : polygon) {
        low.emplace_back(p.x(), p.y(), -half_height);
        high.emplace_back(taper * p.x(), taper * p.y(), half_height);
    }
    return join_rings({low, high}, {Point(0.0, 0.0, -half_height), Point(0.0, 0.0, half_height)});
}

Solid make_torus(double radius, double tube)
{
    constexpr int around_tube = 64;
    std::vector<Ring> rings;
    for (const Point& p : ellipse(around_tube, tube, tube)) {
        Ring& ring = rings.emplace_back(ellipse(circle_corners, radius + p.x(), radius + p.x()));
        for (Point& q : ring)
            q.z() = p.y();
    }
    return join_rings(rings, {});
}

Solid draw_body(RandomNumbers& random)
{
    const auto draw_two = [&](double least, double most) {
        const double first = between(random, least, most);
        return std::pair(first, between(random, least, most));
    };
    const auto draw_radii = [&](double least, double most) {
        const auto [a, b] = draw_two(least, most);
        return Point(a, b, between(random, least, most));
    };
    const auto draw_prism = [&](const Ring& polygon) {
        const double half_height = between(random, 0.2, 1.0);
        return make_prism(polygon, half_height, chance(random, 0.3) ? between(random, 0.3, 0.9) : 1.0);
    };
    switch (random.below(8)) {
    case 0:
    case 1: {
        const auto [a, b] = draw_two(0.5, 1.3);
        return make_prism(ellipse(4, a, b, full_turn / 8.0), between(random, 0.2, 0.9));
    }
    case 2: {
        const auto [a, b] = draw_two(0.3, 0.9);
        return draw_prism(ellipse(circle_corners, a, b));
    }
    case 3: {
        const int n_points = whole_between(random, 3, 9);
        return draw_prism(make_star(n_points, between(random, 0.5, 0.95)));
    }
    case 4:
        return make_ellipsoid(draw_radii(0.4, 1.0));
    case 5: {
        const double radius = between(random, 0.6, 0.9);
        return make_torus(radius, between(random, 0.12, 0.35));
    }
    case 6: {
        const auto [a, b] = draw_two(0.5, 1.1);
        return draw_prism(ellipse(whole_between(random, 3, 8), a, b));
    }
    default: {
        const Point radii = draw_radii(0.5, 0.9);
        const double power_along = between(random, 0.15, 0.6);
        return make_ellipsoid(radii, power_along, between(random, 0.15, 1.0));
    }
    }
}

}  // namespace seamflow
