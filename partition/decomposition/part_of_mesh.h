#pragma once

#include <cstdint>
#include <span>

#include "partition/decomposition/decomposition.h"

namespace seamflow {

/// Cuts a part of a mesh into the sub-meshes that it contains as a whole. The others, the fragments, have only the
/// faces that the part has, and their vertices; they have no Γ, own nothing and receive nothing. Everything else is as
/// in the decomposition of the whole mesh, except for numbers, if those of the part are in the same order. However,
/// where a fragment would own a vertex, the lowest of the whole sub-meshes that have it does.
/// @param labels #F, each in 0 to #sub-meshes - 1, every value used.
/// @param is_whole #sub-meshes: 1 where the part has all faces, all faces around their vertices, and all faces around
///        the vertices of these.
Decomposition decompose_part(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                             std::span<const std::uint8_t> is_whole, const Executor& exec = run_serially);

}  // namespace seamflow
