#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/sweep/factor_windows.h"
#include "engine/sweep/remote_sub_meshes.h"
#include "engine/sweep/sweep_plan.h"
#include "engine/tasks/task_graph.h"

namespace seamflow {

/// Performs a task of this kind for a sub-mesh.
using PerformTask = std::function<void(TaskKind kind, Index s)>;

/// Adds one sweep over all sub-meshes to a graph, with a root of its own. Without predictions the sweep has three tasks
/// for each sub-mesh:
///
///     assemble and factorise ──► solve ──► accept
///                                  ▲         ▲
///        solve of the adjacent ────┘         └──── solve of all
///        sub-meshes that lead                      adjacent sub-meshes
///        it on Γ
///
/// With predictions there are two more: predict comes between the first two tasks of each sub-mesh that follows
/// another, and use predictions before the solve of each sub-mesh that leads. With the classical conditions every
/// sub-mesh leads, and solve waits for the adjacent sub-meshes of lower stage. So that few factors live at once,
/// assemble and factorise also waits for the solve of an earlier sub-mesh (see FactorWindow). No barrier separates
/// colours.
///
/// For remote sub-meshes, the arrivals of predictions and solutions replace these tasks. Assemble and factorise waits
/// for the positions of remote sub-meshes around.
/// @param sweep the number of the plan, from 0.
/// @param plan is not used after the call.
/// @param adjacency per sub-mesh: the sub-meshes with which it shares vertices.
/// @param predicts whether sub-meshes predict.
/// @param remote null if the sweep has all sub-meshes of the mesh.
void add_sweep(TaskGraph& graph, const PerformTask& perform, std::size_t sweep, const SweepPlan& plan,
               const std::vector<std::vector<Index>>& adjacency, const FactorWindow& window, bool predicts,
               RemoteSubMeshes* remote);

}  // namespace seamflow
