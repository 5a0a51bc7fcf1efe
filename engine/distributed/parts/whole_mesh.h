#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/distributed/ranks/packing.h"
#include "partition/polygon_mesh.h"

/// Converts a whole mesh on rank 0 to the ranges of all ranks, and back: for small meshes, and for what is done in one
/// go. All ranks call these functions together.
namespace seamflow {

/// The first of n elements that belong to a rank's range, if ranges are of about the same length and begin at
/// multiples of `block`; n for rank n_ranks.
std::int64_t begin_of_range(std::int64_t n, int rank, int n_ranks, std::int64_t block);

/// The ranges of a mesh, without labels.
/// @param mesh of rank 0; what others give is ignored. @param block see begin_of_range.
RankSlice hand_out(Communicator& comm, const PolygonMesh& mesh, Index block);

/// Sends a number per vertex or face to the rank in whose range it is.
/// @param numbers of rank 0, of the whole mesh; what others give is ignored.
/// @param bounds of vertices or faces (see SliceBounds).
/// @returns those of the range.
template <class Number>
std::vector<Number> hand_out(Communicator& comm, const std::vector<Number>& numbers,
                             std::span<const std::int64_t> bounds)
{
    std::vector<Bytes> to_each(comm.size());
    for (std::size_t r = 0; comm.rank() == 0 && r < to_each.size(); ++r)
        to_each[r] = packed(std::vector<Number>(numbers.begin() + bounds[r], numbers.begin() + bounds[r + 1]));
    return unpacked<Number>(comm.exchange(std::move(to_each)).front());
}

/// The positions of all ranges at rank 0, #V of the whole mesh by 3; elsewhere 0 by 3.
Points gather_positions(Communicator& comm, const Points& own);

/// The whole mesh at rank 0; elsewhere an empty one.
PolygonMesh gather_mesh(Communicator& comm, const RankSlice& slice);

}  // namespace seamflow
