#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "engine/measure/mesh_size.h"
#include "engine/measure/run_report.h"
#include "engine/options/motion_options.h"
#include "engine/surface/flowing_mesh.h"
#include "engine/tasks/progress.h"
#include "partition/remark.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// A surface before it moves: the mesh that moves, and what is known of it.
struct Surface {
    FlowingMesh mesh;
    /// Of the mesh that moves, with the vertices that may move.
    Topology topology = {};
    MeshSize size = {};
    /// The vertices of the given mesh that no face uses, ascending.
    std::vector<Index> unused_vertices = {};
    /// What was done with the faces, a sentence each.
    std::vector<Remark> choices = {};
    std::vector<Remark> remarks = {};
};

/// What a surface is made for.
struct SurfaceRequest {
    /// Vertices at which this Laplacian is not defined are fixed.
    Laplacian laplacian = Laplacian::Fujiwara;
    /// Whether faces that repeat others stay.
    bool keeps_all_faces = false;
    /// Whether faces without a moving vertex are left out.
    bool leaves_out_still_faces = false;
    /// May replace the faces, once vertices are joined, and add a sentence to Surface::choices. Empty: they stay.
    /// @returns whether it replaced them.
    std::function<bool(Surface& surface)> replace_faces = {};
};

/// Leaves out faces, joins vertices along seams, and determines which vertices move.
/// @param mesh valid, as given. @param motion resolved (see resolved_motion.h).
/// @returns the surface, and the constraints on the motion of its mesh: those of joined vertices are then those of the
///          vertices that represent them.
/// @throws as constrain.
std::pair<Surface, MotionOptions> make_surface(FlowingMesh mesh, MotionOptions motion, const SurfaceRequest& request,
                                               Progress& progress);

/// Counts the vertices of a surface, and those that do not move.
/// @param strength see MotionOptions::strength: where it is 0, vertices that are not manifold do not count.
MeshReport report_on(const Surface& surface, const std::vector<double>& strength);

}  // namespace seamflow
