#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"

namespace seamflow {

/// A cut of a mesh that no rank has as a whole.
struct SlicedCut {
    /// Labelled with the parts.
    RankSlice& slice;
    const SliceBounds& bounds;
    /// One entry per corner of the range: whether its half-edge has a twin of another face (see Topology).
    const std::vector<std::uint8_t>& has_twin;
};

/// The faces around some vertices, as rank 0 gets them from all ranks.
struct Band {
    MeshPart part;
    /// #V of the band: whether it has all faces of the mesh around the vertex.
    std::vector<std::uint8_t> is_whole;
};

/// Gathers `layers` layers of faces around vertices at rank 0: first all faces around them, then those around the
/// corners of these. All ranks call this together.
/// @param slice with labels. @param vertices of rank 0, ascending; others give none.
/// @returns the band at rank 0, nothing at the others.
Band gather_band(Communicator& comm, const RankSlice& slice, const SliceBounds& bounds,
                 const std::vector<std::int64_t>& vertices, int layers);

}  // namespace seamflow
