#pragma once

#include <memory>

#include "engine/setup/step_settings.h"
#include "engine/setup/way_of_steps.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Makes a stepper for backward Euler steps of the whole mesh by one factorisation: exact. It is one of the steppers
/// for meshes that are cut into sub-meshes, and its only sub-mesh is the whole mesh. There are two of these steppers,
/// which differ in how the sub-meshes agree on Γ, the vertices that they share: in sweeps (SweepStepper) they solve
/// once, one after the other; converged steps (SchurStepper) are iterated until they are the steps of the whole mesh. A
/// single sub-mesh has no Γ, so that both give the same step.
/// @param mesh, topology, progress must outlive the stepper.
/// @param way with a tolerance only for symmetric equations: steps then report their residual.
/// @throws ComputationError if the analysis fails; MemoryLimitError if the memory limit is too low; Cancelled.
std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const StepSettings& settings, const UndecomposedSteps& way,
                                                   Progress& progress);

}  // namespace seamflow
