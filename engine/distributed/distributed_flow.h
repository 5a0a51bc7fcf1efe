#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/distributed/parts/mesh_part.h"
#include "engine/distributed/rank_report.h"
#include "engine/distributed/ranks/communicator.h"
#include "engine/distributed/ranks/transport.h"
#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "partition/metrics/length_statistics.h"

namespace seamflow {

/// What an observer on a rank sees after each step.
struct RankStepState {
    /// Number of the step, from 1.
    int step = 0;
    const StepReport& report;
    /// The part of this rank that the flow was given, with the positions after the step. If the flow fails, it is as
    /// before the first.
    const MeshPart& part;
    /// For collective functions that observers on all ranks call together.
    Communicator& comm;
    /// The state to resume from. All ranks call it together.
    /// @param vertices #V of this rank's range by 3, as in RankFlowState; those without faces stay.
    std::function<RankFlowState(const Points& vertices)> capture;
};

/// Called after each step, on all ranks, in the thread that called the flow. What one throws, all ranks throw.
using RankObserver = std::function<void(const RankStepState&)>;

/// Mean curvature flow of a mesh that no rank has as a whole, in sweeps over the sub-meshes of all ranks, or in
/// converged steps for which they solve on Γ together. Each rank gives some of the sub-meshes with all their faces, and
/// gets their vertices moved. All ranks call this together, with the same options. The result is, bit for bit, that of
/// mean_curvature_flow with these labels and the same approach, for any number of ranks, and of threads of each.
///
/// Not yet supported: approaches other than Approach::Sweep and Approach::Converged, and the latter with Δ_P, whose
/// equations are not symmetric; sweeps with conditions other than the adapted ones; Scheme::ExplicitEuler; keep_edges;
/// rescale; strict; ReportOptions other than `measures`, and of these the curvature and the parts of displacements;
/// FlowOptions::radius. Vertices along seams stay as they are, as with an empty MotionOptions::weld (see cut_together).
/// Labels, fixed vertices, attachment weights and strengths are those of the part; all its faces flow, also those that
/// mean_curvature_flow leaves out around a region (see leave_out_still_faces). Faces that repeat others at places where
/// the mesh is not manifold take no part.
/// @param part its vertices are moved when the flow has succeeded on all ranks; those without faces never are.
/// @param on_step may be empty; on all ranks or on none.
/// @param resume null, or the state after a step: the flow continues from there, on any number of ranks, with the same
///        bits; part and options are as before the first step. On all ranks or on none.
/// @throws on all ranks the same: OptionError; InputError for a part that is invalid, for a sub-mesh of several ranks,
///         or for one that is not connected or has several fans of faces around a vertex (mean_curvature_flow would
///         move its faces); ComputationError naming step and sub-mesh.
RankReport distributed_mean_curvature_flow(Transport& transport, MeshPart& part, const FlowOptions& options,
                                           const RankObserver& on_step = {}, const RankFlowState* resume = nullptr);

}  // namespace seamflow
