#pragma once

#include <functional>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The mesh with the same vertices, and only the faces f for which keeps(f) is true.
PolygonMesh with_faces(const PolygonMesh& mesh, const std::function<bool(Index f)>& keeps);

}  // namespace seamflow
