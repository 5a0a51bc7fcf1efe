#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"
#include "partition/topology.h"

namespace seamflow {

/// Sets the labels of a range to the chunks of its faces: ranges of Hilbert's curve through their centroids, with
/// about `size` faces each, which depend on the mesh alone. All ranks call this together.
/// @param size at least 1.
void label_chunks(Communicator& comm, RankSlice& slice, const SliceBounds& bounds, Index size);

/// A range of Hilbert's curve through a mesh (see label_chunks), which a rank has as a whole.
struct Chunk {
    /// Its label is the number of the chunk.
    MeshPart part;
    /// Edges of three faces or more in the whole mesh have no twins; nor do edges to other chunks.
    Topology topology;
    /// #V of the chunk: whether other chunks have faces there, too.
    std::vector<std::uint8_t> is_shared;
    /// The half-edges of edges of two faces, the other of which is in another chunk, ascending.
    std::vector<Index> crossing;
};

/// Gives every chunk to one rank. All ranks call this together.
/// @param slice labelled with chunks; left without labels.
/// @returns those of this rank, ascending.
std::vector<Chunk> deal_chunks(Communicator& comm, RankSlice& slice, const SliceBounds& bounds);

}  // namespace seamflow
