#pragma once

#include <vector>

#include "partition/index_lists.h"
#include "partition/decomposition/sub_mesh.h"
#include "solvers/sub_mesh_system.h"

namespace seamflow {

/// Frees what nobody looks at any more of a sub-mesh's own faces: their corners are a twentieth of a flow's memory, the
/// twins of their half-edges another one.
inline void release_faces(FacesInUse in_use, SubMesh& sub_mesh)
{
    if (in_use == FacesInUse::All)
        return;
    sub_mesh.twin = std::vector<Index>();
    if (in_use == FacesInUse::None)
        sub_mesh.face_vertices = IndexLists();
}

}  // namespace seamflow
