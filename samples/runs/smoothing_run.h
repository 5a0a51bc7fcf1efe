#pragma once

#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/polygon_mesh.h"
#include "samples/options/smooth_request.h"
#include "samples/report/run_record.h"

/// The work around the smoothing of a mesh, in a file or in memory.
namespace seamflow {

/// The record of a run before its mesh is known.
RunRecord begin_record(const SmoothRequest& request);

/// The distance at which --weld joins borders, in length, once options are resolved; 0 if it joins none.
double seam_distance_of(const MotionOptions& motion);

/// Adds a remark on vertices that count in no length because no face uses them, where they lie far away.
void remark_on_vertices(const PolygonMesh& mesh, const MeshScale& scale, const Executor& exec,
                        std::vector<Remark>& remarks);

/// Chooses an amount by the preset, and resolves the options for the mesh (see resolved_options.h); records what they
/// follow from in `run`.
/// @param mesh valid (see require_valid).
/// @throws InputError for a mesh that has no size to measure by.
void resolve_amount(SmoothRequest& request, const PolygonMesh& mesh, const Executor& exec, RunRecord& run);

/// A surface that flows by mean curvature shrinks, which surprises those who only wanted it smooth: adds a remark if it
/// has lost much of its volume, or most of its area if it encloses none; where sheets meet, if cells have lost much.
void remark_on_loss(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks);

/// Adds a remark, with a remedy, if the surface has folded over, or crosses itself where it did not before, or if
/// sheets lie on each other so that cells are not known.
void remark_on_folds(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks);

/// "the tolerance 1e-08 was missed in 2 steps"; empty if the user has requested no tolerance or no step has failed.
/// Those fail that missed it, or, if the user has limited the iterations, those that stagnated.
std::string missed_tolerance(const SmoothRequest& request, const ConvergenceReport& report);

}  // namespace seamflow
