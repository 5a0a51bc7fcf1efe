#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"

namespace seamflow {

/// Σ‖ΔV‖ of each sub-mesh over its vertices that are neither fixed nor on Γ.
/// @param curvature #V: ‖ΔV⁰‖; empty: as if it were 0. @returns #sub-meshes.
std::vector<double> total_curvatures(const Decomposition& decomposition, const std::vector<double>& curvature);

/// #sub-meshes: the stage of each sub-mesh in a forward sweep, from 0; sub-meshes of one stage have one colour. The
/// colours are ordered by decreasing total curvature: the paper's authors let the side with the larger curvature begin.
/// @param solves_in_order_of_numbers whether the stage of a sub-mesh is its number instead.
/// @param adjacency per sub-mesh: the others with which it shares a vertex of Γ. @param totals the total
/// curvature of each sub-mesh (see total_curvatures).
std::vector<Index> assign_stages(const std::vector<std::vector<Index>>& adjacency, bool solves_in_order_of_numbers,
                                 const std::vector<double>& totals);

/// The stages of the sweep in the opposite direction.
std::vector<Index> reversed(const std::vector<Index>& stage);

}  // namespace seamflow
