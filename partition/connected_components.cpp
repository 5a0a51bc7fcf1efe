#include "partition/connected_components.h"

namespace seamflow {

Components face_components(const PolygonMesh& mesh, const Topology& topology)
{
    return connected_components(mesh.n_faces(), [&](Index f, auto&& visit) {
        for_each_neighbour(mesh, topology, f, [&](Index, Index g) { visit(g); });
    });
}

}  // namespace seamflow
