#pragma once

#include "engine/measure/flow_report.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Smooths a mesh by mean curvature flow: `options.steps` backward Euler steps (paper, eq. 3)
///
/// \f[ (I + dt\, \Delta(V^n))\, V^{n+1} = V^n , \f]
///
/// decomposed into sub-meshes, or explicit steps (see Scheme). Vertices without faces and, unless
/// MotionOptions::boundary is free, boundary vertices do not move, bit for bit.
/// @param mesh its positions are moved; after an exception they are those of the last complete step. The running flow
///        owns the mesh.
/// @param on_step called after each step.
/// @param control reports progress, stops the flow, or resumes it from an earlier step: `mesh` is then as it was before
///        the first step, and the report covers all steps.
/// @throws InputError for a mesh or labels that cannot be used, OptionError for options outside their limits, both for
///         a state to resume from that belongs to another flow; ComputationError, naming step and sub-mesh, for a
///         system that is singular, a result that is not finite or beyond AccuracyOptions::largest_update, and for a
///         failure of METIS; Cancelled if control.stop was requested and work was left; std::bad_alloc.
FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step = {},
                               const FlowControl& control = {});

}  // namespace seamflow
