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

/// Chooses an amount by the preset, and resolves the options for the mesh (see resolved_options.h); records what they
/// follow from in `run`.
/// @param mesh valid (see require_valid). @param run with the scale of the mesh.
/// @throws InputError for a mesh that has no size to measure by.
void resolve_amount(SmoothRequest& request, const PolygonMesh& mesh, const Executor& exec, RunRecord& run);

}  // namespace seamflow
