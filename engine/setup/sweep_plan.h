#pragma once

#include <span>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/executor.h"
#include "solvers/systems/interface_role.h"

namespace seamflow {

/// One pass over all sub-meshes, colour by colour: which sub-mesh leads at which vertices of Γ, and what crosses Γ
/// after which colour.
struct SweepPlan {
    /// #sub-meshes; a sub-mesh solves after all adjacent ones of an earlier stage. Adjacent sub-meshes have different
    /// stages.
    std::vector<Index> stage;
    /// For each sub-mesh, its role at each vertex of its Γ.
    std::vector<std::vector<InterfaceRole>> roles;
    /// For each receiving sub-mesh, the Vᵏ⁺¹ on Γ that it takes over, available as soon as the sender (of an earlier
    /// stage) has solved. Senders in ascending order.
    std::vector<std::vector<Transfer>> traces;
    /// For each receiving sub-mesh, the prediction of its surroundings: those vertices of its halo that share a face
    /// with a vertex of Γ where it leads. The senders, all of a later stage, know them before the receiver solves;
    /// where several do, the lowest sends. Senders in ascending order.
    std::vector<std::vector<Transfer>> predictions;
    /// For each receiving sub-mesh of a mutual sweep, the copies that the other sub-meshes have of its Γ: one transfer
    /// from each adjacent one, in ascending order. Empty in other sweeps.
    std::vector<std::vector<Transfer>> copies;
};

/// A plan for sub-meshes of these stages, with nothing to do yet.
SweepPlan empty_plan(std::vector<Index> stage);

/// Plans the sweep in which sub-meshes solve in ascending order of `stage`.
/// @param stage #sub-meshes, different for adjacent sub-meshes.
SweepPlan plan_sweep(const Decomposition& decomposition, std::vector<Index> stage, const Executor& exec = run_serially);

/// Plans a sweep in which every sub-mesh leads everywhere, so that each keeps its own copy of Γ (the classical
/// conditions). There are no traces and no predictions.
/// @param stage #sub-meshes, different for adjacent sub-meshes.
SweepPlan plan_mutual_sweep(const Decomposition& decomposition, std::vector<Index> stage,
                            const Executor& exec = run_serially);

/// Plans the sweep of sub-meshes that overlap (see overlap.h), in the order for which the decomposition was made: each
/// follows everywhere on its interface. The traces carry V^{k+1} where the part of the earliest stage at the vertex
/// solves earlier; elsewhere V^k is used.
SweepPlan plan_overlapping_sweep(const Decomposition& decomposition, std::vector<Index> stage);

}  // namespace seamflow
