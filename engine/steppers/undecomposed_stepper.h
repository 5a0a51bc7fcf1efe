#pragma once

#include <memory>

#include "engine/setup/step_settings.h"
#include "engine/setup/way_of_steps.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Makes a stepper for backward Euler steps of the whole mesh by one factorisation: exact. It is one of those for
/// sub-meshes, with a single one. A single sub-mesh has no Γ, at which sweeps and converged steps could differ.
/// @param mesh, topology, progress must outlive the stepper.
/// @param way with a tolerance only for symmetric equations: steps then report their residual.
/// @throws ComputationError if the analysis fails; MemoryLimitError if the memory limit is too low; Cancelled.
std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const StepSettings& settings, const UndecomposedSteps& way,
                                                   Progress& progress);

}  // namespace seamflow
