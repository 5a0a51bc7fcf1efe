#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The faces of a whole mesh, with copies of vertices such that no two sub-meshes share one.
struct SeparatedSubMeshes {
    /// The faces in the order of the mesh. Its vertices come first, in their order, each of them the copy of the lowest
    /// sub-mesh there; the copies of the others follow.
    PolygonMesh mesh;
    /// For each sub-mesh, the vertex of `mesh` that each of its own vertices is.
    std::vector<std::vector<Index>> vertex_of;
};

/// Separates the sub-meshes of a mesh. Every copy starts where the vertex is.
/// @param decomposition without overlap (see decompose).
SeparatedSubMeshes separate(const PolygonMesh& mesh, const Decomposition& decomposition);

}  // namespace seamflow
