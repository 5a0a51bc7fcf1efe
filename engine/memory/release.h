#pragma once

#include <utility>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/index_lists.h"
#include "solvers/systems/sub_mesh_system.h"

namespace seamflow {

/// Frees the arrays of a sub-mesh's own faces that are no longer read. Their corners are a twentieth of a flow's
/// memory, the twins of their half-edges another twentieth.
inline void release_faces(FacesInUse in_use, SubMesh& sub_mesh)
{
    if (in_use == FacesInUse::All)
        return;
    sub_mesh.twin = std::vector<Index>();
    if (in_use == FacesInUse::None)
        sub_mesh.face_vertices = IndexLists();
}

/// Frees what sub-meshes store about each other, except for the vertices of Γ.
inline void release_surroundings(Decomposition& decomposition)
{
    decomposition.adjacency = std::vector<std::vector<Index>>();
    decomposition.halo = std::vector<std::vector<Transfer>>();
    for (SubMesh& sub_mesh : decomposition.sub_meshes) {
        SubMeshInterface interface;
        interface.vertices.swap(sub_mesh.interface.vertices);
        sub_mesh.interface = std::move(interface);
        sub_mesh.seam = SubMeshSeam();
    }
}

}  // namespace seamflow
