#include "partition/cut/umbrellas.h"

#include <algorithm>

#include "partition/index.h"

namespace seamflow {

UmbrellaWalker::UmbrellaWalker(const PolygonMesh& mesh, const Topology& topology)
    : mesh_(&mesh)
    , topology_(&topology)
{
}

/// Steps over half-edge `spoke` at v into the next face.
/// @returns the corner there and the other half-edge at v; -1, -1 at the end of the umbrella.
UmbrellaWalker::Step UmbrellaWalker::across(Index v, Index spoke) const
{
    const Index twin = topology_->twin[at(spoke)];
    if (twin < 0)
        return {-1, -1};
    if (mesh_->face_vertices[at(twin)] == v)
        return {twin, topology_->previous(*mesh_, twin)};
    const Index corner = topology_->next(*mesh_, twin);
    return {corner, corner};
}

/// The first corner of the umbrella that `corner` belongs to, or `corner` itself if it is closed, and the half-edge
/// over which to leave it.
UmbrellaWalker::Step UmbrellaWalker::start(Index corner) const
{
    const Index v = mesh_->face_vertices[at(corner)];
    Step here{corner, topology_->previous(*mesh_, corner)};
    for (;;) {
        const Step next = across(v, here.spoke);
        if (next.corner == corner)
            return {corner, corner};
        if (next.corner < 0)
            break;
        here = next;
    }
    const Index previous = topology_->previous(*mesh_, here.corner);
    return {here.corner, here.spoke == here.corner ? previous : here.corner};
}

/// Appends the faces of an umbrella. @returns whether it is closed.
bool UmbrellaWalker::append_umbrella(Index v, Index corner)
{
    const auto corners = topology_->corners_at(v);
    const Step first = start(corner);
    Step here = first;
    do {
        const auto place = std::lower_bound(corners.begin(), corners.end(), here.corner) - corners.begin();
        met_[static_cast<std::size_t>(place)] = true;
        faces_.push_back(topology_->face_of[at(here.corner)]);
        here = across(v, here.spoke);
    } while (here.corner >= 0 && here.corner != first.corner);
    return here.corner >= 0;
}

std::span<const Umbrella> UmbrellaWalker::at_vertex(Index v)
{
    const auto corners = topology_->corners_at(v);
    met_.assign(corners.size(), false);
    faces_.clear();
    faces_.reserve(corners.size());  // so that the spans below stay valid
    umbrellas_.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (met_[i])
            continue;
        const std::size_t begin = faces_.size();
        const bool closed = append_umbrella(v, corners[i]);
        umbrellas_.push_back({std::span<const Index>(faces_).subspan(begin), closed});
        if (faces_.size() == corners.size())
            break;
    }
    return umbrellas_;
}

}  // namespace seamflow
