#include "partition/metrics/triangle_distance.h"

#include <algorithm>
#include <limits>

namespace seamflow {

namespace {

/// Squared distance of the origin from its foot in the plane of the triangle, infinite if that lies outside.
double squared_distance_to_inside(const Point& a, const Point& b, const Point& c)
{
    const Point u = b - a;
    const Point w = c - a;
    const double uu = u.squaredNorm();
    const Point height = w - (w.dot(u) / uu) * u;
    const double hh = height.squaredNorm();
    double s = 0.0;
    double t = 0.0;
    Point foot = a;
    // Further passes mend what the rounding of `height` did to the first one in a thin triangle.
    for (int pass = 0; pass < 3; ++pass) {
        const double dt = -foot.dot(height) / hh;
        s -= (foot + dt * w).dot(u) / uu;
        t += dt;
        foot = a + s * u + t * w;
    }
    // Not a number for a triangle without area: that is not inside either.
    const bool inside = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
    return inside ? foot.squaredNorm() : std::numeric_limits<double>::infinity();
}

}  // namespace

double squared_distance_to_segment(const Point& a, const Point& b)
{
    const Point u = b - a;
    const double uu = u.squaredNorm();
    if (!(uu > 0.0))
        return std::min(a.squaredNorm(), b.squaredNorm());
    const double s = std::clamp(-a.dot(u) / uu, 0.0, 1.0);
    return std::min(b.squaredNorm(), (a + s * u).squaredNorm());
}

double squared_distance_to_triangle(const Point& a, const Point& b, const Point& c)
{
    return std::min({squared_distance_to_segment(a, b), squared_distance_to_segment(b, c),
                     squared_distance_to_segment(c, a), squared_distance_to_inside(a, b, c)});
}

}  // namespace seamflow
