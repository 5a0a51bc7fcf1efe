#include "partition/metrics/vertex_normals.h"

#include <algorithm>

namespace seamflow {

namespace {

bool is_oriented(const PolygonMesh& mesh, const Topology& topology, const Loop& loop)
{
    const auto is_turned = [&](Index h) {
        const Index twin = topology.twin[h];
        return twin >= 0 && mesh.face_vertices[h] == mesh.face_vertices[twin];
    };
    std::vector<std::uint8_t> has_turned(at(mesh.n_corners() / block_size) + 1, 0);
    for_each_block(loop, mesh.n_corners(), [&](Index block, Index begin, Index end) {
        for (Index h = begin; h < end && has_turned[block] == 0; ++h)
            has_turned[block] = is_turned(h) ? 1 : 0;
    });
    return std::ranges::find(has_turned, 1) == has_turned.end();
}

/// Turns the faces of a fan alike. Its corners come in order around the vertex: a face that goes round it the same way
/// has its previous vertex on the edge to the face before.
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

VertexNormals::VertexNormals(const PolygonMesh& mesh, const Topology& topology, const Loop& loop)
    : mesh_(mesh)
    , topology_(topology)
{
    if (is_oriented(mesh, topology, loop))
        return;
    sense_.assign(mesh.n_corners(), 1);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        for (const Fan& fan : fans_at(mesh, topology, v, {}, 0))
            align(mesh, topology, fan, sense_);
}

Point VertexNormals::operator()(Index v, const Points& positions) const
{
    return (*this)(topology_.corners_at(v), positions);
}

Point VertexNormals::operator()(std::span<const Index> corners, const Points& positions) const
{
    Point sum = Point::Zero();
    for (const Index corner : corners)
        sum += (sense_.empty() ? 1 : sense_[corner]) * vector_area(mesh_.face(topology_.face_of[corner]), positions);
    sum.stableNormalize();
    return sum;
}

}  // namespace seamflow
