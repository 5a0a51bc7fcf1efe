#pragma once

#include "engine/denoise/denoise_options.h"
#include "engine/denoise/denoise_report.h"
#include "engine/measure/run_report.h"
#include "engine/options/flow_control.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Removes the noise of a mesh, and nothing else: edges, round parts, details and clean meshes stay as they are.
/// Nothing has to be chosen. Other methods (see DenoiseMethod) smooth between edges, or the boundary alone, by an
/// amount that is given. Vertices without faces do not move, bit for bit.
/// @param mesh its positions are moved; after an exception they are those of the last complete step.
/// @param on_step called after each step.
/// @param control reports progress, stops the steps, or resumes them from an earlier one: `mesh` is then as it was
///        before the first step, and the report covers all steps. Ranks do not share these steps.
/// @throws InputError for a mesh that cannot be used, OptionError for options outside their limits, InputError for a
///         state to resume from that belongs to another mesh or other options; ComputationError, naming the step, for a
///         result that is not finite; Cancelled if control.stop was requested and work was left; std::bad_alloc.
DenoiseReport denoise(PolygonMesh& mesh, const DenoiseOptions& options = {}, const StepObserver& on_step = {},
                      const FlowControl& control = {});

}  // namespace seamflow
