#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/ranks/communicator.h"

namespace seamflow {

/// Fetches face labels from the ranks that read them. All ranks call this together.
/// @param labels of the range of this rank. @param bounds those of its faces. @param faces ascending, in the whole
/// mesh.
/// @returns one label per face.
std::vector<Index> fetch_labels(Communicator& comm, std::span<const Index> labels, const SliceBounds& bounds,
                                std::span<const std::int64_t> faces);

/// Sends the labels of parts to the ranges that have their faces, and which of their half-edges have twins. All
/// ranks call this together; each face is in one part.
/// @param has_twin called with the index of a part in `parts` and a half-edge.
/// @param twins_of_slice gets one entry per corner of the range.
void send_home(Communicator& comm, const SliceBounds& bounds, std::span<const MeshPart* const> parts,
               const std::function<bool(std::size_t, Index)>& has_twin, RankSlice& slice,
               std::vector<std::uint8_t>& twins_of_slice);

}  // namespace seamflow
