#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/metrics/spikes.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The measures of edges that need all edges to be visited, once.
struct EdgeMeasures {
    /// See mean_edge_length.
    double mean = 0.0;
    /// See find_spikes.
    std::vector<Spike> spikes;
};

/// Measures all edges.
/// @param positions #V by 3.
EdgeMeasures measure_edges(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

}  // namespace seamflow
