#include "solvers/degenerate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

void require_length(const PolygonMesh& mesh, const Topology& topology, Index f)
{
    const auto corners = mesh.face(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Index start = corners[k];
        const Index end = corners[(k + 1) % corners.size()];
        const bool matters =
            topology.kind[at(start)] == VertexKind::Interior || topology.kind[at(end)] == VertexKind::Interior;
        const double length = (mesh.vertices.row(end) - mesh.vertices.row(start)).norm();
        if (matters && !std::isnormal(length))
            throw InputError("vertices " + std::to_string(start) + " and " + std::to_string(end) +
                             " (numbered from 0) are joined by an edge of face " + std::to_string(f) +
                             " and lie at the same place, or so near or far that the distance is no normal double: "
                             "merge them, move one, or scale the mesh");
    }
}

bool may_move(const PolygonMesh& mesh, const Topology& topology, Index f)
{
    const auto corners = mesh.face(f);
    return std::any_of(corners.begin(), corners.end(),
                       [&](Index v) { return topology.kind[at(v)] == VertexKind::Interior; });
}

/// Does the row of a vertex that may move divide by the area of face f? Those of Ptáčková-Velho also reach the faces
/// across the edges of the vertex's own.
bool area_matters(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian, Index f)
{
    if (may_move(mesh, topology, f))
        return true;
    if (laplacian != Laplacian::PtackovaVelho)
        return false;
    const auto twins = std::span<const Index>(topology.twin).subspan(at(mesh.face_offsets[at(f)]), mesh.face(f).size());
    return std::any_of(twins.begin(), twins.end(),
                       [&](Index twin) { return twin >= 0 && may_move(mesh, topology, topology.face_of[at(twin)]); });
}

void require_area(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian, Index f)
{
    const bool matters = area_matters(mesh, topology, laplacian, f);
    if (matters && !std::isnormal(area(mesh.face(f), mesh.vertices)))
        throw InputError("face " + std::to_string(f) +
                         " (numbered from 0) has no area that is a normal double: remove it, move one of its vertices, "
                         "or use the Laplacian fujiwara, "
                         "which does not divide by areas");
}

}  // namespace

void require_sound_geometry(const PolygonMesh& mesh, const Topology& topology, Laplacian laplacian)
{
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (laplacian == Laplacian::Fujiwara)
            require_length(mesh, topology, f);
        else
            require_area(mesh, topology, laplacian, f);
}

}  // namespace seamflow
