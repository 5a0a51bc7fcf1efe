#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/vector_area.h"

namespace seamflow {

/// A vertex along a seam (see weld), as numbered in the whole mesh.
struct SeamVertex {
    std::int64_t vertex;
    /// The lowest of those that it moves as one with; maybe itself.
    std::int64_t first;
    /// Where it was, and where that one is after joining.
    double own[3];
    double joined[3];
};

/// What has become one along seams of a mesh that no rank has as a whole.
struct JoinedSeams {
    /// Ascending; the same at all ranks.
    std::vector<SeamVertex> vertices = {};
    /// How many of them stand for none any more.
    std::int64_t n_copies = 0;
    /// For the user, a sentence; empty where there are no seams.
    std::string remark = {};
};

/// Joins the seams of a mesh, as weld does: the faces along the boundary come to rank 0. All ranks call this together.
/// @param slice gets corners at the first vertices alone, and those in the middle of what they were.
/// @param boundary of this rank: vertices on edges of one face. Those of all ranks are all there are.
JoinedSeams join_seams(Communicator& comm, RankSlice& slice, const SliceBounds& bounds,
                       const std::vector<std::int64_t>& boundary, double distance);

/// Puts what has moved as one where it belongs. All ranks call this together.
/// @param slice with the vertices after the flow, or after some steps of it; gets the others, too. What has not moved
///        is where it was.
void bring_back(Communicator& comm, const JoinedSeams& seams, RankSlice& slice);

}  // namespace seamflow
