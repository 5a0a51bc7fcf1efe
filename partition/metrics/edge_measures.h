#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/metrics/spikes.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The measures of edges that need all edges to be visited, once.
struct EdgeMeasures {
    /// The mean length of the half-edges, without those of spikes if these change it much (see mean_edge_length).
    double mean = 0.0;
    /// The vertices far from all of their neighbours (see find_spikes).
    std::vector<Spike> spikes;
};

/// Measures all edges.
/// @param positions #V by 3.
EdgeMeasures measure_edges(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

}  // namespace seamflow
