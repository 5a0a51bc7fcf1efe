#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/ranks/communicator.h"
#include "partition/cut/face_graph.h"

namespace seamflow {

/// What one rank knows of the clusters of faces (see FaceClusters) of a mesh that no rank has as a whole. They are
/// numbered rank by rank, and chunk by chunk within a rank.
struct ClusterShare {
    /// One entry per cluster of this rank (see face_weight).
    std::vector<std::int64_t> weights;
    /// One entry per chunk of this rank: the number of its clusters.
    std::vector<Index> of_chunk;
    /// #ranks + 1: the first cluster of each rank.
    std::vector<std::int64_t> bounds;
    /// Between any clusters; entries for the same two, of one or several ranks, are added up.
    std::vector<ClusterContact> contacts;
};

struct DividedClusters {
    /// One entry per cluster of this rank: its part.
    std::vector<Index> labels;
    /// One entry per part of all ranks, without pieces to be joined to neighbours.
    std::vector<std::int64_t> weights;
    /// The connected components of the blocks of all ranks.
    Index n_components = 0;
    /// The parts of this rank's blocks that also have small pieces, which are to go to the parts around them.
    std::vector<Index> loose_parts;
};

/// Divides clusters into parts of about equal weight with short boundaries (METIS). Consecutive chunks form a block,
/// whose clusters one rank divides; no part lies in two blocks. All ranks call this together; the result does not
/// depend on their number.
/// @param k at least 2; about this many parts, more if there are more components.
/// @param chunks_of_block the most chunks in a block, at least 1.
/// @throws ComputationError if METIS fails.
DividedClusters divide_together(Communicator& comm, const ClusterShare& clusters, Index k, Index chunks_of_block);

}  // namespace seamflow
