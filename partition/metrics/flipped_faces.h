#pragma once

#include <vector>

#include "partition/loop.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The faces whose normal, the direction of their vector area, has turned by more than 90° from `before` to `after`.
/// Faces without area in either state have none, and are not counted.
/// @param before, after #V by 3, in units of length.
/// @returns ascending.
std::vector<Index> flipped_faces(const PolygonMesh& mesh, const Points& before, const Points& after,
                                 const Loop& loop = run_serially);

}  // namespace seamflow
