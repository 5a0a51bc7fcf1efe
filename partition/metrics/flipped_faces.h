#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The faces whose normal, the direction of their vector area, has turned by more than 90° from `before` to `after`.
/// Faces without area in either state have no normal, and are not counted.
/// @param before, after #V by 3, in units of length.
/// @returns ascending.
std::vector<Index> flipped_faces(const PolygonMesh& mesh, const Points& before, const Points& after,
                                 const Executor& exec = run_serially);

/// The flipped faces that oppose the faces around their vertices in the state `after`, and did not in the state
/// `before`: the surface has folded there. Other flipped faces had been turned by noise before, or belong to regions
/// that turned as a whole. Where faces are not oriented alike, folded faces may be missed.
/// @param flipped the result of flipped_faces for the same positions.
std::vector<Index> folded_faces(const PolygonMesh& mesh, const Points& before, const Points& after,
                                const std::vector<Index>& flipped);

}  // namespace seamflow
