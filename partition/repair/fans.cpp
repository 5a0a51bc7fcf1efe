#include "partition/repair/fans.h"

#include <algorithm>

#include "partition/index.h"

namespace seamflow {

FanWalker::FanWalker(const PolygonMesh& mesh, const Topology& topology)
    : mesh_(&mesh)
    , topology_(&topology)
{
}

/// Steps over half-edge `spoke` at v into the next face.
/// @returns the corner there and the other half-edge at v; -1, -1 at the end of the fan.
FanWalker::Step FanWalker::across(Index v, Index spoke) const
{
    const Index twin = topology_->twin[spoke];
    if (twin < 0)
        return {-1, -1};
    if (mesh_->face_vertices[twin] == v)
        return {twin, topology_->previous(*mesh_, twin)};
    const Index corner = topology_->next(*mesh_, twin);
    return {corner, corner};
}

/// The first corner of the fan that `corner` belongs to, or `corner` itself if it is closed, and the half-edge
/// over which to leave it.
FanWalker::Step FanWalker::start(Index corner) const
{
    const Index v = mesh_->face_vertices[corner];
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

/// Appends the faces of a fan. @returns whether it is closed.
bool FanWalker::append_fan(Index v, Index corner)
{
    const auto corners = topology_->corners_at(v);
    const Step first = start(corner);
    Step here = first;
    do {
        const auto place = std::lower_bound(corners.begin(), corners.end(), here.corner) - corners.begin();
        met_[static_cast<std::size_t>(place)] = true;
        faces_.push_back(topology_->face_of[here.corner]);
        here = across(v, here.spoke);
    } while (here.corner >= 0 && here.corner != first.corner);
    return here.corner >= 0;
}

std::span<const FanWalker::Fan> FanWalker::at_vertex(Index v)
{
    const auto corners = topology_->corners_at(v);
    met_.assign(corners.size(), false);
    faces_.clear();
    faces_.reserve(corners.size());  // so that the spans below stay valid
    fans_.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (met_[i])
            continue;
        const std::size_t begin = faces_.size();
        const bool closed = append_fan(v, corners[i]);
        fans_.push_back({std::span<const Index>(faces_).subspan(begin), closed});
        if (faces_.size() == corners.size())
            break;
    }
    return fans_;
}

}  // namespace seamflow
