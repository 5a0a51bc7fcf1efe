#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow
{

/// The connected components of a mesh. Faces are connected through edges of exactly two faces: a shared vertex or an
/// edge of three or more faces connects nothing.
struct FaceComponents {
    /// #F, from 0 to count - 1, numbered by their lowest face.
    std::vector<Index> component;
    Index count = 0;
};

/// Finds the connected components of the faces. Linear in the size of the mesh.
FaceComponents face_components(const PolygonMesh& mesh, const Topology& topology);

}  // namespace seamflow
