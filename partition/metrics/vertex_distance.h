#pragma once

#include "partition/executor.h"
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

/// The mean length over the half-edges of a mesh, so that an interior edge counts twice; 0 without faces. Edges of
/// spikes (see find_spikes) are left out if one is longer than four times the mean: a single height that stands for
/// missing data would make all other edges short in comparison.
double mean_edge_length(const PolygonMesh& mesh);

/// The mean edge length (see above) at given positions, #V by 3.
double mean_edge_length(const PolygonMesh& mesh, const Points& positions, const Executor& exec = run_serially);

/// Distances between `candidate` and `reference`, #V by 3 each, over all vertices that faces use, or over all vertices
/// if there are no faces; `mesh` has the faces.
/// @throws InputError if the numbers of vertices differ, including that of `mesh`.
VertexDistance vertex_distance(const PolygonMesh& mesh, const Points& reference, const Points& candidate);

}  // namespace seamflow
