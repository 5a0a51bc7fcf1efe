#pragma once

#include <functional>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The same vertices, and the faces for which keeps(f) holds.
PolygonMesh with_faces(const PolygonMesh& mesh, const std::function<bool(Index f)>& keeps);

}  // namespace seamflow
