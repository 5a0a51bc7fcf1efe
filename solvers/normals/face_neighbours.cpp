#include "solvers/normals/face_neighbours.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "partition/index_lists.h"
#include "partition/parallel_lists.h"

namespace seamflow {

namespace {

/// The fans at vertices of more than most_at_vertex faces.
class CrowdedFans {
  public:
    CrowdedFans(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
        : topology_(&topology)
    {
        const auto crowded = select(exec, mesh.n_vertices(), [&](Index v) {
            return topology.corners_at(v).size() > FaceNeighbours::most_at_vertex;
        });
        for (const Index v : crowded)
            for (Fan& fan : fans_at(mesh, topology, v, {}, 0)) {
                for (std::size_t i = 0; i < fan.corners.size(); ++i)
                    fan_corners_.push_back({fan.corners[i], fans_.size(), i});
                fans_.push_back(std::move(fan));
            }
        std::ranges::sort(fan_corners_, {}, &FanCorner::corner);
    }

    /// Appends faces that are evenly spaced in the fan of a corner, as many on one side of the corner's face as on the
    /// other unless the fan ends there, so that neighbours are mutual.
    void append_spaced(Index corner, std::vector<Index>& list) const
    {
        const auto fan_corner = std::ranges::lower_bound(fan_corners_, corner, {}, &FanCorner::corner);
        const Fan& fan = fans_[fan_corner->fan];
        const std::size_t n = fan.corners.size();
        const std::size_t here = fan_corner->in_fan;
        constexpr std::size_t on_a_side = FaceNeighbours::most_at_vertex / 2;
        for (std::size_t k = 1; k <= on_a_side; ++k) {
            const std::size_t away = k * n / FaceNeighbours::most_at_vertex;
            if (fan.closed || here + away < n)
                list.push_back(topology_->face_of[fan.corners[(here + away) % n]]);
            if (fan.closed || here >= away)
                list.push_back(topology_->face_of[fan.corners[(here + n - away) % n]]);
        }
    }

  private:
    /// A corner, the index of its fan in fans_, and its index in this fan.
    struct FanCorner {
        Index corner;
        std::size_t fan;
        std::size_t in_fan;
    };

    const Topology* topology_;
    std::vector<Fan> fans_;
    /// The corners of these fans, ascending.
    std::vector<FanCorner> fan_corners_;
};

/// Appends the faces of the fan in which a corner is.
void append_fan(const PolygonMesh& mesh, const Topology& topology, Index corner, std::vector<Index>& list)
{
    for (const Fan& fan : fans_at(mesh, topology, mesh.face_vertices[corner], {}, 0))
        if (std::ranges::find(fan.corners, corner) != fan.corners.end())
            for (const Index other : fan.corners)
                list.push_back(topology.face_of[other]);
}

/// Replaces `list` by the neighbours of face f (see FaceNeighbours): ascending, distinct, without f.
void list_neighbours(const PolygonMesh& mesh, const Topology& topology, const CrowdedFans& crowded, Sheets sheets,
                     Index f, std::vector<Index>& list)
{
    list.clear();
    for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
        const Index v = mesh.face_vertices[h];
        const auto corners = topology.corners_at(v);
        if (corners.size() > FaceNeighbours::most_at_vertex)
            crowded.append_spaced(h, list);
        else if (sheets == Sheets::Own && topology.kind[v] != VertexKind::Interior)
            append_fan(mesh, topology, h, list);
        else
            for (const Index corner : corners)
                list.push_back(topology.face_of[corner]);
        if (topology.twin[h] >= 0)
            list.push_back(topology.face_of[topology.twin[h]]);
    }
    sort_unique(list);
    std::erase(list, f);
}

}  // namespace

FaceNeighbours make_face_neighbours(const PolygonMesh& mesh, const Topology& topology, const Executor& exec,
                                    Sheets sheets)
{
    const CrowdedFans crowded(mesh, topology, exec);
    FaceNeighbours neighbours;
    make_lists_in_parallel(
        exec, mesh.n_faces(),
        [&](Index f, std::vector<Index>& list) { list_neighbours(mesh, topology, crowded, sheets, f, list); },
        neighbours.offsets, neighbours.faces);
    return neighbours;
}

std::vector<std::int8_t> face_signs(const PolygonMesh& mesh, const Topology& topology)
{
    if (topology.oriented)
        return {};
    std::vector<std::int8_t> signs(usize(mesh.n_faces()), 0);
    std::vector<Index> next;
    for (Index first = 0; first < mesh.n_faces(); ++first) {
        if (signs[first] != 0)
            continue;
        signs[first] = 1;
        next.assign(1, first);
        while (!next.empty()) {
            const Index f = next.back();
            next.pop_back();
            for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
                const Index twin = topology.twin[h];
                if (twin < 0 || signs[topology.face_of[twin]] != 0)
                    continue;
                const bool alike = mesh.face_vertices[h] != mesh.face_vertices[twin];
                signs[topology.face_of[twin]] = static_cast<std::int8_t>(alike ? signs[f] : -signs[f]);
                next.push_back(topology.face_of[twin]);
            }
        }
    }
    return signs;
}

}  // namespace seamflow
