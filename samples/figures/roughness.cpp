#include "samples/figures/roughness.h"

#include <cmath>
#include <numbers>

#include "partition/vector_area.h"

namespace seamflow {

namespace {

std::vector<Point> vector_areas(const PolygonMesh& mesh, const Points& positions)
{
    std::vector<Point> areas;
    areas.reserve(at(mesh.n_faces()));
    for (Index f = 0; f < mesh.n_faces(); ++f)
        areas.push_back(vector_area(mesh.face(f), positions));
    return areas;
}

/// In degrees; not a number if one of them has no direction.
double angle_between(const Point& a, const Point& b)
{
    if (!(a.norm() > 0.0) || !(b.norm() > 0.0))
        return std::nan("");
    return std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / std::numbers::pi;
}

}  // namespace

double roughness(const PolygonMesh& mesh, const Topology& topology, const Points& positions)
{
    const std::vector<Point> areas = vector_areas(mesh, positions);
    double squares = 0.0;
    Index edges = 0;
    for (Index h = 0; h < mesh.n_corners(); ++h) {
        const Index twin = topology.twin[at(h)];
        if (twin < h)
            continue;
        // Half-edges that run in the same direction belong to faces of opposite orientation.
        const double sense = mesh.face_vertices[at(h)] == mesh.face_vertices[at(twin)] ? -1.0 : 1.0;
        const double angle =
            angle_between(areas[at(topology.face_of[at(h)])], sense * areas[at(topology.face_of[at(twin)])]);
        if (std::isnan(angle))
            continue;
        squares += angle * angle;
        ++edges;
    }
    return edges == 0 ? 0.0 : std::sqrt(squares / edges);
}

}  // namespace seamflow
