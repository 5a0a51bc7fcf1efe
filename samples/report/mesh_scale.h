#pragma once

#include <vector>

#include "engine/measure/length_scale.h"
#include "partition/metrics/edge_measures.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// The sizes of a mesh by which amounts of smoothing are measured, in units of length.
struct MeshScale {
    double mean_edge = 0.0;
    /// Of the bounding box of all vertices that faces use.
    double diagonal = 0.0;
    /// Vertices that no face uses, and which lie far from all faces, ascending.
    std::vector<Index> far_vertices = {};
    std::vector<Spike> spikes = {};

    /// For options that are given by these sizes.
    [[nodiscard]] LengthScale lengths() const { return {mean_edge, diagonal}; }
};

MeshScale measure_scale(const PolygonMesh& mesh, const Executor& exec = run_serially);

}  // namespace seamflow
