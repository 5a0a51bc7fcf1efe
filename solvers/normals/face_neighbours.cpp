#include "solvers/normals/face_neighbours.h"

#include <algorithm>

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
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    std::erase(list, f);
}

}  // namespace

FaceNeighbours make_face_neighbours(const PolygonMesh& mesh, const Topology& topology, const Executor& exec)
{
    FaceNeighbours neighbours;
    neighbours.offsets.assign(usize(mesh.n_faces()) + 1, 0);
    exec(mesh.n_faces(), [&](Index begin, Index end) {
        std::vector<Index> list;
        for (Index f = begin; f < end; ++f) {
            list_neighbours(mesh, topology, f, list);
            neighbours.offsets[f + 1] = list.size();
        }
    });
    for (Index f = 0; f < mesh.n_faces(); ++f)
        neighbours.offsets[f + 1] += neighbours.offsets[f];
    neighbours.faces.resize(neighbours.offsets.back());
    exec(mesh.n_faces(), [&](Index begin, Index end) {
        std::vector<Index> list;
        for (Index f = begin; f < end; ++f) {
            list_neighbours(mesh, topology, f, list);
            std::copy(list.begin(), list.end(),
                      neighbours.faces.begin() + static_cast<std::ptrdiff_t>(neighbours.offsets[f]));
        }
    });
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
