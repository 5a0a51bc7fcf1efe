#pragma once

#include <cstdint>
#include <vector>

#include "engine/distributed/communicator.h"
#include "engine/distributed/mesh_part.h"
#include "engine/options/flow_options.h"

namespace seamflow {

/// One step as a rank sees it.
struct RankStepReport {
    /// Wall-clock time.
    double seconds = 0.0;
    /// What the rank has sent to others.
    std::uint64_t messages = 0;
    std::uint64_t bytes = 0;
};

/// What a distributed flow did.
struct RankReport {
    /// Of the whole mesh.
    Index sub_meshes = 0;
    Index colours = 0;
    std::int64_t interface_vertices = 0;
    /// Of this rank: the vertices of its sub-meshes, and those that it knows of others.
    Index vertices = 0;
    Index foreign_vertices = 0;
    /// All that is done before the first step, wall-clock time.
    double setup_seconds = 0.0;
    std::vector<RankStepReport> steps;
};

/// Mean curvature flow of a mesh that no rank has as a whole, in sweeps over the sub-meshes of all ranks. Each rank
/// gives some of them with all their faces, and gets their vertices moved. All ranks call this together, with the same
/// options. The result is, bit for bit, that of mean_curvature_flow with these labels and Approach::Sweep, for any
/// number of ranks, and of threads of each.
///
/// Not for distributed flows are, so far: approaches but Approach::Sweep; other conditions than the adapted ones;
/// Scheme::ExplicitEuler; keep_edges; a free boundary; attachment weights; rescale; strict; what ReportOptions asks
/// for beside `measures`, which count as if they were off; FlowOptions::radius. Vertices along seams stay as they are,
/// as with an empty MotionOptions::weld. Labels and fixed vertices are those of the part.
/// @param part its vertices are moved when the flow has succeeded on all ranks; those without faces never are.
/// @throws on all ranks the same: OptionError; InputError for a part that is not sound, for a sub-mesh of several
///         ranks, for one that is not connected or has several fans of faces around a vertex (mean_curvature_flow would
///         move its faces), and for faces that repeat others; ComputationError naming step and sub-mesh.
RankReport distributed_mean_curvature_flow(Communicator& communicator, MeshPart& part, const FlowOptions& options);

}  // namespace seamflow
