#pragma once

#include "partition/polygon_mesh.h"

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

/// The sizes of a mesh.
/// @pre the mesh is valid (see require_valid).
MeshSize size_of(const PolygonMesh& mesh);

}  // namespace seamflow
