#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/conversation.h"
#include "partition/polygon_mesh.h"

/// Which elements of a mesh each rank has, and how they move where that changes. Bounds are #ranks + 1: the first
/// element of each rank and, at the end, how many there are. All ranks call these functions together.
namespace seamflow {

/// The bounds if all ranks in their order have so many.
std::vector<std::int64_t> gather_bounds_of(Conversation& talk, std::int64_t n_own);

/// See begin_of_stretch.
std::vector<std::int64_t> bounds_of_stretches(std::int64_t n, int n_ranks, std::int64_t block);

/// Gives rows to the ranks that are to have them.
/// @param own those of this rank by the bounds `from`. @returns those of this rank by the bounds `to`.
Points move_rows(Conversation& talk, const Points& own, const std::vector<std::int64_t>& from,
                 const std::vector<std::int64_t>& to);

/// Makes stretches as SharedMeshFile::read gives them of what ranks have found in slices of a file.
/// @param found without labels; its corners are numbered in the whole mesh.
RankSlice move_to_stretches(Conversation& talk, RankSlice found, Index block);

/// The same as a mesh, with corners numbered in the whole mesh.
PolygonMesh mesh_of(const RankSlice& slice);

}  // namespace seamflow
