#include "partition/metrics/triangle_crossing.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "partition/metrics/exact_crossing.h"

namespace seamflow {

namespace {

/// A bound of the rounding error of all sums of products here, relative to the sum of their absolute values: no term
/// has more than a dozen roundings of half an epsilon.
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
/// A bound of the rounding error of products that are not normal doubles.
constexpr double underflow = 1e-290;

/// A number and a bound of its error.
struct Estimate {
    double value;
    double error;

    [[nodiscard]] bool is_positive() const { return value > error; }
    [[nodiscard]] bool is_negative() const { return value < -error; }
    [[nodiscard]] bool has_sign() const { return is_positive() || is_negative(); }
};

/// A scalar product. If products overflow, the bound of its error is infinite.
Estimate dot(const Point& d, const Point& p)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double error = rounding * d.cwiseAbs().dot(p.cwiseAbs()) + underflow;
    return error < infinity ? Estimate{d.dot(p), error} : Estimate{0.0, infinity};
}

/// The absolute values of the products in a × b, added up.
Point size_of_cross(const Point& a, const Point& b)
{
    const Point x = a.cwiseAbs();
    const Point y = b.cwiseAbs();
    return {x[1] * y[2] + x[2] * y[1], x[2] * y[0] + x[0] * y[2], x[0] * y[1] + x[1] * y[0]};
}

/// Six times the signed volume of the tetrahedron that a, b, c and the origin span.
Estimate volume(const Point& a, const Point& b, const Point& c)
{
    return {a.cross(b).dot(c), rounding * size_of_cross(a, b).dot(c.cwiseAbs()) + underflow};
}

/// Bounds of the values of three points along an axis.
struct Span {
    double low;
    double high;

    Span(const Point& axis, const TriangleCorners& t)
    {
        const Estimate e[3] = {dot(axis, t[0]), dot(axis, t[1]), dot(axis, t[2])};
        low = std::min({e[0].value - e[0].error, e[1].value - e[1].error, e[2].value - e[2].error});
        high = std::max({e[0].value + e[0].error, e[1].value + e[1].error, e[2].value + e[2].error});
    }
};

/// Whether the triangles have no value along an axis in common, despite rounding.
bool separates(const Point& axis, const TriangleCorners& a, const TriangleCorners& b)
{
    const Span of_a(axis, a);
    const Span of_b(axis, b);
    return of_a.high < of_b.low || of_b.high < of_a.low;
}

TriangleCorners edges_of(const TriangleCorners& t)
{
    return {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
}

/// Whether a plane separates the triangles: a plane along one of their edges and normal to the triangle, as on a smooth
/// surface; parallel to one of them; or parallel to an edge of each. With exact numbers, one of these separates any two
/// disjoint triangles; with rounding, triangles that nearly touch may be missed.
bool are_apart(const TriangleCorners& a, const TriangleCorners& b)
{
    const TriangleCorners edges_a = edges_of(a);
    const TriangleCorners edges_b = edges_of(b);
    const Point normal_a = edges_a[0].cross(edges_a[1]);
    const Point normal_b = edges_b[0].cross(edges_b[1]);
    const auto is_between = [&](const Point& axis) { return separates(axis, a, b); };
    return std::ranges::any_of(edges_a, [&](const Point& e) { return is_between(normal_a.cross(e)); }) ||
           std::ranges::any_of(edges_b, [&](const Point& e) { return is_between(normal_b.cross(e)); }) ||
           is_between(normal_a) || is_between(normal_b) || std::ranges::any_of(edges_a, [&](const Point& e) {
               return std::ranges::any_of(edges_b, [&](const Point& g) { return is_between(e.cross(g)); });
           });
}

/// Whether p and q are on the same side of the plane through the origin, a and b, and not in it.
bool are_on_one_side(const Point& a, const Point& b, const Point& p, const Point& q)
{
    const Estimate of_p = volume(a, b, p);
    const Estimate of_q = volume(a, b, q);
    return (of_p.is_positive() && of_q.is_positive()) || (of_p.is_negative() && of_q.is_negative());
}

/// For triangles whose first corner is the origin: whether a plane through the origin separates them, or contains one
/// of them and has the other on one side.
bool are_apart_beyond_corner(const TriangleCorners& a, const TriangleCorners& b)
{
    const auto middle = [](const TriangleCorners& t) -> Point { return t[1].normalized() + t[2].normalized(); };
    const Point axis = middle(a) - middle(b);
    return (dot(axis, a[1]).is_positive() && dot(axis, a[2]).is_positive() && dot(axis, b[1]).is_negative() &&
            dot(axis, b[2]).is_negative()) ||
           are_on_one_side(a[1], a[2], b[1], b[2]) || are_on_one_side(b[1], b[2], a[1], a[2]);
}

/// For triangles that share their first corner, the origin, and the second: whether they span a volume, or lie on
/// different sides of their edge.
bool are_apart_beyond_edge(const TriangleCorners& a, const TriangleCorners& b)
{
    const Estimate same_side{a[1].cross(a[2]).dot(a[1].cross(b[2])),
                             rounding * size_of_cross(a[1], a[2]).dot(size_of_cross(a[1], b[2])) + underflow};
    return same_side.is_negative() || volume(a[1], a[2], b[2]).has_sign();
}

/// Moves corners with equal positions to the front, in the same order in both triangles.
/// @returns the number of such corners.
std::size_t bring_shared_to_front(TriangleCorners& a, TriangleCorners& b)
{
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = n; j < 3; ++j)
            if (a[i] == b[j]) {
                std::swap(a[n], a[i]);
                std::swap(b[n], b[j]);
                ++n;
                break;
            }
    return n;
}

/// The corners relative to a point near both triangles.
TriangleCorners seen_from(const Point& origin, const TriangleCorners& t)
{
    return {t[0] - origin, t[1] - origin, t[2] - origin};
}

/// Whether neither triangle has all its corners on one line, decided exactly.
bool have_area(const TriangleCorners& a, const TriangleCorners& b)
{
    return !exact::is_flat(a) && !exact::is_flat(b);
}

}  // namespace

bool cross(const TriangleCorners& first, const TriangleCorners& second)
{
    TriangleCorners a = first;
    TriangleCorners b = second;
    const std::size_t n_shared = bring_shared_to_front(a, b);
    const TriangleCorners near_a = seen_from(a[0], a);
    const TriangleCorners near_b = seen_from(a[0], b);
    switch (n_shared) {
    case 0:
        return !are_apart(near_a, near_b) && have_area(a, b) && exact::meet(a, b);
    case 1:
        return !are_apart_beyond_corner(near_a, near_b) && have_area(a, b) && exact::meet_beyond_corner(a, b);
    case 2:
        return !are_apart_beyond_edge(near_a, near_b) && have_area(a, b) && exact::meet_beyond_edge(a, b);
    default:
        return !exact::is_flat(a);
    }
}

}  // namespace seamflow
