#pragma once

#include <vector>

#include "engine/options/flow_options.h"
#include "engine/setup/sweep_plan.h"
#include "partition/decomposition/decomposition.h"

namespace seamflow {

/// Σ‖ΔV‖ of each sub-mesh over those of its vertices that are neither on the boundary nor on Γ.
/// @param curvature #V: ‖ΔV⁰‖; empty: as if it were 0. @returns #sub-meshes.
std::vector<double> total_curvatures(const Decomposition& decomposition, const std::vector<double>& curvature);

/// Stage of each sub-mesh in a forward sweep, from 0; sub-meshes of one stage have one colour. With Colouring::Greedy
/// the colour classes are ordered by decreasing total curvature: the paper's authors let the side where it is larger
/// start.
/// @param adjacency #sub-meshes: with which others they share a vertex of Γ. @param totals see total_curvatures.
std::vector<Index> assign_stages(const std::vector<std::vector<Index>>& adjacency, Colouring colouring,
                                 const std::vector<double>& totals);

/// The stages of the sweep in the opposite direction.
std::vector<Index> reversed(const std::vector<Index>& stage);

/// How many factors live at once. Sub-meshes are factorised in a fixed order: the one at place i + size waits until the
/// i-th of `freed` has been solved and its factor is freed.
struct FactorWindow {
    /// The sub-meshes in the order in which they are factorised.
    std::vector<Index> order;
    /// The same sub-meshes in the order in which they can be solved meanwhile.
    std::vector<Index> freed;
    Index size = 0;
};

/// An order in which few factors live at once: each sub-mesh comes shortly before the first solve that needs it.
/// @param order of the same sub-meshes; adjacent ones are near each other.
std::vector<Index> order_by_need(const SweepPlan& plan, const std::vector<Index>& order);

/// The smallest window with which a sweep along this order cannot deadlock: a sub-mesh is solved only after those whose
/// results or predictions it uses have been factorised.
FactorWindow least_window(const SweepPlan& plan, std::vector<Index> order);

}  // namespace seamflow
