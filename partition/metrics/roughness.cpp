#include "partition/metrics/roughness.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "partition/metrics/triangulation.h"
#include "partition/topology.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// The angle in degrees; NaN if one of the vectors has no direction.
double angle_between(const Point& a, const Point& b)
{
    if (!(a.norm() > 0.0) || !(b.norm() > 0.0))
        return std::nan("");
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

/// The angles between the triangles on both sides of every edge, in degrees.
std::vector<double> angles(const PolygonMesh& triangles)
{
    const Topology topology = make_topology(triangles);
    std::vector<Point> areas;
    areas.reserve(triangles.n_faces());
    for (Index f = 0; f < triangles.n_faces(); ++f)
        areas.push_back(has_area(triangles.face(f), triangles.vertices)
                            ? vector_area(triangles.face(f), triangles.vertices)
                            : Point(Point::Zero()));
    std::vector<double> angles;
    for (Index h = 0; h < triangles.n_corners(); ++h) {
        const Index twin = topology.twin[h];
        if (twin < h)
            continue;
        // Half-edges that run in the same direction belong to faces of opposite orientation.
        const double sense = triangles.face_vertices[h] == triangles.face_vertices[twin] ? -1.0 : 1.0;
        const double angle = angle_between(areas[topology.face_of[h]], sense * areas[topology.face_of[twin]]);
        if (!std::isnan(angle))
            angles.push_back(angle);
    }
    return angles;
}

}  // namespace

Roughness roughness(const PolygonMesh& mesh, const Points& positions)
{
    std::vector<double> all = angles(fans_around_centres(mesh, positions).triangles);
    if (all.empty())
        return {};
    double squares = 0.0;
    for (const double angle : all)
        squares += angle * angle;
    const auto percentile = all.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(all.size() - 1));
    std::nth_element(all.begin(), percentile, all.end());
    return {.rms = std::sqrt(squares / static_cast<double>(all.size())), .percentile_95 = *percentile};
}

}  // namespace seamflow
