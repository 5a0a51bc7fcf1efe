#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "partition/vector_area.h"
#include "solvers/laplacian/laplacian.h"

/// Measures of a surface: its size and its mean curvature.
namespace seamflow {

/// The sizes from which sub-meshes and time steps are chosen.
struct MeshSize {
    Index vertices = 0;
    /// The area of all faces, length².
    double area = 0.0;
    /// The mean length of the edges, edges between two faces counting twice (see mean_edge_length); 0 without faces.
    double mean_edge = 0.0;
    /// Whether every edge has a length that is a normal double.
    bool has_lengths = true;
};

/// The area of all faces, in length², whichever way they are oriented.
double total_area(const PolygonMesh& mesh);

/// @pre the mesh is valid (see require_valid).
MeshSize size_of(const PolygonMesh& mesh);

/// #V: ‖ΔV‖ at every interior vertex that may move, 0 at the others, in 1/length. On a free boundary ΔV is not the mean
/// curvature. Runs in parallel.
std::vector<double> measure_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                      const ScaledLaplacian& laplacian);

/// The largest finite value of a list, in 1/length.
double largest_curvature(const std::vector<double>& curvature);

/// The largest finite value of measure_curvature, without a list of the values.
double measure_largest_curvature(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                 const ScaledLaplacian& laplacian);

}  // namespace seamflow
