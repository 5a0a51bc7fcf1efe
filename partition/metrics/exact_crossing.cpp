#include "partition/metrics/exact_crossing.h"

// Header-only exact numbers: no further library is linked for the few cases that need them.
#define CGAL_DISABLE_GMP 1
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace seamflow::exact {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 usize(const Point& p)
{
    return {p[0], p[1], p[2]};
}

Kernel::Triangle_3 triangle(const TriangleCorners& t)
{
    return {usize(t[0]), usize(t[1]), usize(t[2])};
}

/// The edge opposite to the first corner.
Kernel::Segment_3 opposite_edge(const TriangleCorners& t)
{
    return {usize(t[1]), usize(t[2])};
}

}  // namespace

bool is_flat(const TriangleCorners& t)
{
    return CGAL::collinear(usize(t[0]), usize(t[1]), usize(t[2]));
}

bool meet(const TriangleCorners& a, const TriangleCorners& b)
{
    return CGAL::do_intersect(triangle(a), triangle(b));
}

bool meet_beyond_corner(const TriangleCorners& a, const TriangleCorners& b)
{
    return CGAL::do_intersect(triangle(a), opposite_edge(b)) || CGAL::do_intersect(triangle(b), opposite_edge(a));
}

bool meet_beyond_edge(const TriangleCorners& a, const TriangleCorners& b)
{
    return CGAL::coplanar(usize(a[0]), usize(a[1]), usize(a[2]), usize(b[2])) &&
           CGAL::coplanar_orientation(usize(a[0]), usize(a[1]), usize(a[2]), usize(b[2])) == CGAL::POSITIVE;
}

}  // namespace seamflow::exact
