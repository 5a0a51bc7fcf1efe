#pragma once

#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/executor.h"
#include "solvers/systems/interface_role.h"

namespace seamflow {

/// One pass over all sub-meshes, colour by colour: the roles of the sub-meshes at the vertices of Γ, and the data that
/// cross Γ after each colour.
struct SweepPlan {
    /// #sub-meshes: the position of the sub-mesh's colour in the sweep. A sub-mesh solves after all adjacent sub-meshes
    /// of an earlier stage. Adjacent sub-meshes have different stages.
    std::vector<Index> stage;
    /// For each sub-mesh, its role at each vertex of its Γ.
    std::vector<std::vector<InterfaceRole>> roles;
    /// For each receiving sub-mesh: the transfers of Vᵏ⁺¹ on Γ where it follows, possible as soon as the sender, which
    /// has an earlier stage, has solved. Senders in ascending order.
    std::vector<std::vector<Transfer>> traces;
    /// For each receiving sub-mesh: the transfers of predictions at those vertices of its halo that share a face with a
    /// vertex of Γ where it leads. The senders, all of a later stage, predict before the receiver solves; if several
    /// sub-meshes predict a vertex, the lowest sends it. Senders in ascending order.
    std::vector<std::vector<Transfer>> predictions;
    /// For each receiving sub-mesh of a mutual sweep: the transfers of the other sub-meshes' copies of its Γ, one from
    /// each adjacent sub-mesh, in ascending order. Empty in other sweeps.
    std::vector<std::vector<Transfer>> copies;
};

/// A plan with these stages and without transfers.
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
/// sub-mesh follows everywhere on its interface. The traces carry V^{k+1} to a sub-mesh where the sub-mesh with the
/// earliest stage at the vertex has an earlier stage than it; elsewhere V^k is used.
SweepPlan plan_overlapping_sweep(const Decomposition& decomposition, std::vector<Index> stage);

}  // namespace seamflow
