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
    /// The lowest of the vertices joined with it; maybe itself.
    std::int64_t first;
    /// Where it was, and where `first` is after joining.
    double own[3];
    double joined[3];
};

/// The vertices joined along seams of a mesh that no rank has as a whole.
struct JoinedSeams {
    /// Ascending; the same at all ranks.
    std::vector<SeamVertex> vertices = {};
    /// How many of them no longer have faces.
    std::int64_t n_copies = 0;
    /// A sentence for the user; empty if there are no seams.
    std::string remark = {};
};

/// Joins the seams of a mesh, as weld does: the faces along the boundary go to rank 0. All ranks call this together.
/// @param slice gets corners only at first vertices, placed in the middle of what they join.
/// @param boundary of this rank: vertices on edges of one face. Those of all ranks are all there are.
JoinedSeams join_seams(Communicator& comm, RankSlice& slice, const SliceBounds& bounds,
                       const std::vector<std::int64_t>& boundary, double distance);

/// Puts joined vertices where they belong. All ranks call this together.
/// @param slice with the vertices after the flow, or after some of its steps; gets the others, too. Unmoved ones are
///        where they were.
void bring_back(Communicator& comm, const JoinedSeams& seams, RankSlice& slice);

}  // namespace seamflow
