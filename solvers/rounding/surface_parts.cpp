#include "solvers/rounding/surface_parts.h"

#include <cmath>

#include "partition/vector_area.h"

namespace seamflow {

SurfaceParts::SurfaceParts(const PolygonMesh& mesh, const Topology& topology, const Components& components)
    : mesh_(mesh)
    , topology_(topology)
    , components_(components)
    , part_of_(usize(components.count()), 0)
{
    for (Index c = 0; c < components.count(); ++c)
        if (components.nodes[c].size() >= small_component)
            part_of_[c] = count_++;
}

Index SurfaceParts::of_vertex(Index v) const
{
    const auto corners = topology_.corners_at(v);
    return corners.empty() ? -1 : of_face(topology_.face_of[corners.front()]);
}

std::vector<double> SurfaceParts::bending(const Boxes& boxes, const Points& positions, const Executor& exec) const
{
    std::vector<double> of_halfedges(usize(mesh_.n_corners()));
    for_each(exec, mesh_.n_corners(), [&](Index h) { of_halfedges[h] = bending_at(h, boxes, positions); });
    std::vector<double> of_parts(usize(count_), 0.0);
    for (Index h = 0; h < mesh_.n_corners(); ++h)
        of_parts[of_face(topology_.face_of[h])] += of_halfedges[h];
    return of_parts;
}

double SurfaceParts::bending_at(Index h, const Boxes& boxes, const Points& positions) const
{
    const Index twin = topology_.twin[h];
    if (twin < h)
        return 0.0;
    const Index v = mesh_.face_vertices[h];
    const Index w = mesh_.face_vertices[topology_.next(mesh_, h)];
    if (boxes.half_widths.row(v).isZero(0.0) || boxes.half_widths.row(w).isZero(0.0))
        return 0.0;
    const Point normal = vector_area(mesh_.face(topology_.face_of[h]), positions);
    Point other = vector_area(mesh_.face(topology_.face_of[twin]), positions);
    // Half-edges in the same direction belong to faces with opposite orientations.
    if (mesh_.face_vertices[twin] == v)
        other = -other;
    const double sine = Eigen::RowVector3d(normal.cross(other)).norm();
    return (positions.row(w) - positions.row(v)).norm() * std::atan2(sine, normal.dot(other));
}

}  // namespace seamflow
