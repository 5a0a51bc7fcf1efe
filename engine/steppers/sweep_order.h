#pragma once

#include <vector>

#include "engine/setup/sweep_plan.h"
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

/// A limit on the factors that live at once. Sub-meshes are factorised in a fixed order: order[i + size] waits until
/// freed[i] has been solved and its factor is freed.
struct FactorWindow {
    /// The sub-meshes in the order of factorisation.
    std::vector<Index> order;
    /// The same sub-meshes in an order in which they can be solved meanwhile.
    std::vector<Index> freed;
    /// The most factors that live at once.
    Index size = 0;
};

/// An order in which few factors live at once: each sub-mesh comes shortly before the first solve that needs it.
/// @param order of the same sub-meshes, in which adjacent sub-meshes are near each other.
std::vector<Index> order_by_need(const SweepPlan& plan, const std::vector<Index>& order);

/// The smallest window with which a sweep in this order cannot deadlock: a sub-mesh is solved only after the sub-meshes
/// whose results or predictions it uses have been factorised.
FactorWindow least_window(const SweepPlan& plan, std::vector<Index> order);

}  // namespace seamflow
