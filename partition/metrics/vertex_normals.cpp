#include "partition/metrics/vertex_normals.h"

#include <algorithm>

namespace seamflow {

namespace {

/// Orients the faces of a fan consistently. The corners of the fan are in order around the vertex: a face with the
/// orientation of the fan has its previous vertex on the edge to the face before.
void align(const PolygonMesh& mesh, const Topology& topology, const Fan& fan, std::vector<std::int8_t>& sense)
{
    Index shared = fan.first;
    for (const Index corner : fan.corners) {
        const Index previous = mesh.face_vertices[topology.previous(mesh, corner)];
        const bool along = previous == shared;
        sense[corner] = along ? 1 : -1;
        shared = along ? mesh.face_vertices[topology.next(mesh, corner)] : previous;
    }
    if (sense[*std::ranges::min_element(fan.corners)] < 0)
        for (const Index corner : fan.corners)
            sense[corner] = static_cast<std::int8_t>(-sense[corner]);
}

}  // namespace

VertexNormals::VertexNormals(const PolygonMesh& mesh, const Topology& topology)
    : mesh_(mesh)
    , topology_(topology)
{
    if (topology.oriented)
        return;
    sense_.assign(mesh.n_corners(), 1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const Fan& fan : fans_at(mesh, topology, v, {}, 0))
            align(mesh, topology, fan, sense_);
}

Point VertexNormals::operator()(Index v, const Points& positions) const
{
    if (topology_.kind[v] == VertexKind::Junction)
        return Point::Zero();
    return (*this)(topology_.corners_at(v), positions);
}

Point VertexNormals::operator()(std::span<const Index> corners, const Points& positions) const
{
    Point sum = Point::Zero();
    for (const Index corner : corners)
        sum += sense(corner) * vector_area(mesh_.face(topology_.face_of[corner]), positions);
    sum.stableNormalize();
    return sum;
}

}  // namespace seamflow
