#pragma once

#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "partition/vector_area.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

using CgalPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
/// A closed surface of triangles.
using Solid = CGAL::Surface_mesh<CgalPoint>;
/// The corners of a polygon.
using Ring = std::vector<Point>;

inline CgalPoint to_cgal(const Point& p)
{
    return {p.x(), p.y(), p.z()};
}

inline Point from_cgal(const CgalPoint& p)
{
    return {p.x(), p.y(), p.z()};
}

/// The corners of a polygon on an ellipse in the plane z = 0. @param phase where the first one is: an angle.
Ring ellipse(int n, double a, double b, double phase = 0.0);

/// A prism along the z axis over a polygon that is star-shaped about it.
/// @param taper the size of the upper end, in sizes of the lower one.
Solid make_prism(const Ring& polygon, double half_height, double taper = 1.0);

/// A torus around the z axis.
Solid make_torus(double radius, double tube);

/// A prism, cone, star, ellipsoid, rounded box or torus around the origin, 0.3 to 2.6 long.
Solid draw_body(RandomNumbers& random);

}  // namespace seamflow
