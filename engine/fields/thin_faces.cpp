#include "engine/fields/thin_faces.h"

#include "solvers/laplacian/geometry.h"

namespace seamflow {

bool is_thin(std::span<const Index> face, const Points& positions)
{
    constexpr double thinnest = 1e-10;
    double squares = 0.0;
    Index before = face.back();
    for (const Index v : face) {
        squares += (positions.row(v) - positions.row(before)).squaredNorm();
        before = v;
    }
    return !(area(face, positions) > thinnest * squares);
}

PolygonMesh with_faces(const PolygonMesh& mesh, const std::function<bool(Index f)>& keeps)
{
    PolygonMesh kept;
    kept.vertices = mesh.vertices;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (keeps(f))
            kept.add_face(mesh.face(f));
    return kept;
}

}  // namespace seamflow
