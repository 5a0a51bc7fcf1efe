#pragma once

#include <vector>

#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Whether the faces around a vertex are in the sample from which the roughness of large meshes is estimated: those
/// around some thousands of vertices, spread over the mesh without a pattern. The sample of small meshes has all faces.
bool is_sampled(Index v, Index n_vertices);

/// Some faces as a mesh of their own, without positions.
/// @param faces the vertices of each. @param vertices all of them, ascending.
PolygonMesh extract(const IndexLists& faces, const std::vector<Index>& vertices);

}  // namespace seamflow
