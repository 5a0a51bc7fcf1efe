#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The faces of a whole mesh, with vertices copied so that no two sub-meshes share one.
struct SeparatedSubMeshes {
    /// The faces in the order of the mesh. The vertices of the mesh come first, in order, each as the copy of its
    /// lowest sub-mesh; the copies of other sub-meshes follow.
    PolygonMesh mesh;
    /// For each sub-mesh, the vertex of `mesh` for each of its own vertices.
    std::vector<std::vector<Index>> vertex_of;
};

/// Separates the sub-meshes of a mesh. Every copy has the position of its vertex.
/// @param decomposition without overlap (see decompose).
SeparatedSubMeshes separate(const PolygonMesh& mesh, const Decomposition& decomposition);

}  // namespace seamflow
