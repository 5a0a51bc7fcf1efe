#include "partition/with_faces.h"

namespace seamflow {

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
