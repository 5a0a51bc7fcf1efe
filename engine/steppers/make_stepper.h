#pragma once

#include <memory>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/setup/way_of_steps.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"

namespace seamflow {

/// Makes the stepper for a way of taking steps.
/// @param mesh, topology, progress must outlive the stepper. @param cut the cut that was made for this way.
/// @param curvature #V: ‖ΔV⁰‖, in 1/length; empty: as if it were 0.
/// @throws ComputationError naming the sub-mesh if an analysis fails; MemoryLimitError if the memory limit is too
///         low; Cancelled.
std::unique_ptr<Stepper> make_stepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                      const WayOfSteps& way, const StepSettings& settings,
                                      std::vector<double> curvature, Progress& progress);

/// Makes a stepper for backward Euler steps of the whole mesh by one factorisation.
/// @throws as make_stepper.
std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const StepSettings& settings, Progress& progress);

}  // namespace seamflow
