#pragma once

#include <span>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Cuts out the sub-mesh of the given faces. `interface.sharing` and `index_in_sharing` are left empty, because they
/// depend on all sub-meshes (see decompose). May be called for several sub-meshes at once.
/// @param labels #F, the sub-mesh of every face.
/// @param faces the faces of one sub-mesh in ascending order. They must form one fan around each vertex of Γ that is an
/// interior vertex of the mesh.
SubMesh make_sub_mesh(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                      std::vector<Index> faces);

/// Reduces `face_vertices` to the faces around vertices of Γ, and renumbers `interface.own_faces`; `faces` stays. It
/// saves memory once the equations are known.
void keep_faces_at_interface(SubMesh& sub_mesh);

}  // namespace seamflow
