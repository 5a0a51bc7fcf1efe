#pragma once

#include <optional>
#include <vector>

#include "engine/choose_tolerance.h"
#include "engine/displacement_meter.h"
#include "engine/flow_options.h"
#include "engine/mesh_size.h"
#include "engine/progress.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"

namespace seamflow {

/// What is measured of a mesh before it flows.
struct Measured {
    std::vector<double> curvature;
    std::optional<DisplacementMeter> meter;
};

/// Cuts, and chooses whether to converge. METIS has one thread: the others measure in the meantime; where it
/// has nothing to do measuring comes afterwards.
/// @param options with the tolerance that was chosen, if any.
Cut cut_and_measure(const PolygonMesh& mesh, const MeshSize& size, const Topology& topology,
                    const ToleranceChoice& choice, FlowOptions& options, Measured& measured, const Progress& progress);

}  // namespace seamflow
