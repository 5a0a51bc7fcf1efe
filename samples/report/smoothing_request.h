#pragma once

#include <optional>
#include <vector>

#include "engine/measure/smoothed_radius.h"
#include "partition/metrics/spikes.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The sizes of a mesh by which amounts of smoothing are measured, in units of length.
struct MeshScale {
    double mean_edge = 0.0;
    /// Of the bounding box of all vertices that faces use.
    double diagonal = 0.0;
    /// Vertices that no face uses, ascending, which lie in no box.
    std::vector<Index> unused_vertices = {};
    std::vector<Spike> spikes = {};
};

MeshScale measure_scale(const PolygonMesh& mesh, const Executor& exec = run_serially);

/// The amount of smoothing of a flow, given in one of three ways.
struct SmoothingRequest {
    /// dt in length².
    double time_step = 0.0;
    /// dt in squared mean edge lengths, if not empty.
    std::optional<double> time_step_edges = {};
    /// The radius that all steps together smooth (see smoothed_radius), if not empty.
    std::optional<LengthOnMesh> radius = {};
};

/// dt in length² for the given number of steps with the given filter.
/// @throws InputError for a mesh that has no size to measure by.
double time_step_of(const SmoothingRequest& request, const MeshScale& scale, int steps, const StepFilter& filter = {});

}  // namespace seamflow
