#pragma once

#include <cstdint>
#include <span>

#include "partition/decomposition/decomposition.h"

namespace seamflow {

/// Cuts a part of a mesh into the sub-meshes that it contains as a whole. Fragments, the sub-meshes of which it
/// contains only some faces, have these faces and their vertices; they have no Γ, own no vertices and receive no data.
/// Whole sub-meshes are as in the decomposition of the whole mesh, except for the numbers of vertices and faces, if
/// these are in the same order in the part. However, a vertex that a fragment would own is owned by the lowest whole
/// sub-mesh that has it.
/// @param labels #F, each in 0 to #sub-meshes - 1, every value used.
/// @param is_whole #sub-meshes: 1 if the part has all faces of the sub-mesh and the two rings of faces around it.
Decomposition decompose_part(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels,
                             std::span<const std::uint8_t> is_whole, const Executor& exec = run_serially);

}  // namespace seamflow
