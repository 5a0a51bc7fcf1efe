#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/conversation.h"
#include "partition/polygon_mesh.h"

/// From a mesh that rank 0 has as a whole to the stretches of all ranks, and back: for small meshes, and for what is
/// done in one go. All ranks call these functions together.
namespace seamflow {

/// The first of n elements that belong to a rank's stretch, if stretches are of about the same length and begin at
/// multiples of `block`; n for rank n_ranks.
std::int64_t begin_of_stretch(std::int64_t n, int rank, int n_ranks, std::int64_t block);

/// The stretches of a mesh, without labels.
/// @param mesh of rank 0; what others give is ignored. @param block see begin_of_stretch.
RankSlice hand_out(Conversation& talk, const PolygonMesh& mesh, Index block);

/// A number of each face to the ranks that have the faces.
/// @param numbers of rank 0, #F of the whole mesh; what others give is ignored.
/// @returns #F of the stretch.
std::vector<Index> hand_out(Conversation& talk, const std::vector<Index>& numbers, const RankSlice& slice);

/// The positions of all stretches at rank 0, #V of the whole mesh by 3; elsewhere 0 by 3.
Points gather_positions(Conversation& talk, const Points& own);

/// The whole mesh at rank 0; elsewhere an empty one.
PolygonMesh gather_mesh(Conversation& talk, const RankSlice& slice);

}  // namespace seamflow
