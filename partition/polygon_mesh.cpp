#include "partition/polygon_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

void require_valid_offsets(const PolygonMesh& mesh)
{
    const auto& offsets = mesh.face_offsets;
    if (offsets.empty() || offsets.front() != 0 || offsets.back() != mesh.n_corners() ||
        !std::is_sorted(offsets.begin(), offsets.end()))
        throw InputError("face_offsets must begin with 0, not decrease, and end with the number of face_vertices (" +
                         std::to_string(mesh.n_corners()) + ")");
}

void require_valid_face(const PolygonMesh& mesh, Index f, std::vector<Index>& last_face_of)
{
    const auto corners = mesh.face(f);
    const auto face = [f] { return "face " + std::to_string(f) + " (numbered from 0)"; };
    if (corners.size() < 3)
        throw InputError(face() + " has " + std::to_string(corners.size()) +
                         " corners: a face needs at least 3; remove the face");
    for (const Index v : corners) {
        if (v < 0 || v >= mesh.n_vertices())
            throw InputError(face() + " names vertex " + std::to_string(v) + ", but the mesh has " +
                             std::to_string(mesh.n_vertices()) + " vertices");
        if (last_face_of[at(v)] == f)
            throw InputError(face() + " names vertex " + std::to_string(v) +
                             " twice: split the face there or remove it");
        last_face_of[at(v)] = f;
    }
}

}  // namespace

void require_valid(const PolygonMesh& mesh)
{
    require_valid_offsets(mesh);
    std::vector<Index> last_face_of(at(mesh.n_vertices()), -1);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        require_valid_face(mesh, f, last_face_of);
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (!mesh.vertices.row(v).allFinite())
            throw InputError("vertex " + std::to_string(v) +
                             " (numbered from 0) has a coordinate that is not a finite number: mend or remove it");
}

}  // namespace seamflow
