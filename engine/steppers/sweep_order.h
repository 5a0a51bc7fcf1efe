#pragma once

#include <vector>

#include "engine/options/flow_options.h"
#include "partition/decomposition/decomposition.h"
#include "partition/topology.h"

namespace seamflow {

/// Rank of each sub-mesh in a forward sweep, from 0; sub-meshes of one rank have one colour. With Coloring::Greedy the
/// colour classes are ranked by decreasing Σ‖ΔV‖ over those vertices of their sub-meshes that are neither on the
/// boundary nor on Γ: the paper's authors let the side with the larger total curvature start.
/// @param curvature #V: ‖ΔV⁰‖.
std::vector<Index> rank_sub_meshes(const Decomposition& decomposition, Coloring coloring,
                                   const std::vector<double>& curvature);

/// The ranks of the sweep in the opposite direction.
std::vector<Index> reversed(const std::vector<Index>& rank);

}  // namespace seamflow
