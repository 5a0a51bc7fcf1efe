#include "solvers/normals/face_neighbours.h"

#include "partition/index_lists.h"
#include "partition/parallel_lists.h"

namespace seamflow {

namespace {

/// The neighbours of face f, until the next call with the same list.
void list_neighbours(const PolygonMesh& mesh, const Topology& topology, Index f, std::vector<Index>& list)
{
    list.clear();
    for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h) {
        const auto corners = topology.corners_at(mesh.face_vertices[h]);
        if (corners.size() <= FaceNeighbours::most_at_vertex)
            for (const Index corner : corners)
                list.push_back(topology.face_of[corner]);
        if (topology.twin[h] >= 0)
            list.push_back(topology.face_of[topology.twin[h]]);
    }
    sort_unique(list);
    std::erase(list, f);
}

}  // namespace

FaceNeighbours make_face_neighbours(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    FaceNeighbours neighbours;
    make_lists_in_parallel(
        exec, mesh.n_faces(), [&](Index f, std::vector<Index>& list) { list_neighbours(mesh, topology, f, list); },
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
