#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/metrics/spikes.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Distances of corresponding vertices of two meshes (paper, section Evaluation): V_mean, V_RMS, V_max.
struct VertexDistance {
    /// In units of length.
    double mean = 0.0;
    double rms = 0.0;
    double max = 0.0;
    /// Mean edge length of the reference, over its half-edges: an interior edge counts twice.
    double mean_edge = 0.0;
};

/// Mean length over the half-edges of a mesh, so that an interior edge counts twice; 0 without faces. Edges of spikes
/// (see find_spikes) are left out where one is longer than four times the mean: one height that stands for no data
/// would make all others short.
double mean_edge_length(const PolygonMesh& mesh);

/// As above for positions other than the mesh's own, #V by 3.
double mean_edge_length(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// Found in one look at all edges.
struct EdgeMeasures {
    /// See mean_edge_length.
    double mean = 0.0;
    /// See find_spikes.
    std::vector<Spike> spikes;
};

/// @param positions #V by 3.
EdgeMeasures measure_edges(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// Distances between `candidate` and `reference`, #V by 3 each, over all vertices that faces use, and over
/// all where there are no faces; `mesh` gives the faces.
/// @throws InputError if the numbers of vertices differ, those of `mesh` included.
VertexDistance vertex_distance(const PolygonMesh& mesh, const Points& reference, const Points& candidate);

}  // namespace seamflow
