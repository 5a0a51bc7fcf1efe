#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"

namespace seamflow {

/// Makes the stepper that the options ask for: explicit Euler steps, backward Euler steps of the
/// whole mesh by conjugate gradients, converged steps by the Schur complement, or sweeps.
/// @param mesh, topology, progress must outlive the stepper.
/// @param options with the tolerance that was chosen, if any.
/// @param curvature #V: ‖ΔV⁰‖, in 1/length; empty: as if it were 0.
/// @throws ComputationError naming the sub-mesh if an analysis fails; MemoryLimitError if the memory limit is too
///         low; Cancelled.
std::unique_ptr<Stepper> make_stepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut,
                                      const FlowOptions& options, std::vector<double> curvature, Progress& progress);

/// Makes a stepper for backward Euler steps of the whole mesh as one, whatever the options on sub-meshes.
/// @param memory_limit used in place of that of the options, in bytes; empty: none.
/// @throws MemoryLimitError if the factorisation needs more.
std::unique_ptr<Stepper> make_undecomposed_stepper(const PolygonMesh& mesh, const Topology& topology,
                                                   const FlowOptions& options, std::optional<std::size_t> memory_limit,
                                                   Progress& progress);

}  // namespace seamflow
