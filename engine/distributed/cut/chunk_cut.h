#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/cut/chunks.h"
#include "engine/distributed/parts/deal.h"
#include "engine/distributed/ranks/communicator.h"

namespace seamflow {

/// A cut before its defects are mended.
struct ChunkCut {
    Index n_parts = 0;
    /// Of the faces of the whole mesh, or, where it has several blocks, of each.
    Index n_components = 0;
    /// The parts that may not be connected, ascending.
    std::vector<Index> suspects = {};
};

/// Cuts a mesh by the clusters of its chunks, whose graph METIS divides, and shortens the seams within chunks.
/// Consecutive chunks form a block, all clusters of which go to one rank; parts do not cross blocks. All ranks call
/// this together.
/// @param chunks those of this rank; their labels become the parts of their faces.
/// @param total_weight of all faces (see face_weight). @param k the number of parts, at least 2.
/// @param chunks_of_block the most chunks in a block, at least 1.
/// @throws ComputationError if METIS fails.
ChunkCut cut_chunks(Communicator& comm, const SliceBounds& bounds, std::vector<Chunk>& chunks, double total_weight,
                    Index k, Index chunks_of_block);

/// The vertices of all ranks at which a part may be pinched (see repair), at rank 0, ascending; nothing at the others.
/// All ranks call this together.
/// @param chunks labelled by parts.
std::vector<std::int64_t> gather_pinch_candidates(Communicator& comm, const SliceBounds& bounds,
                                                  const std::vector<Chunk>& chunks);

}  // namespace seamflow
