#pragma once

#include "partition/polygon_mesh.h"

namespace seamflow {

/// What sub-meshes and time steps are measured by.
struct MeshSize {
    Index vertices = 0;
    /// Of all faces, and of an edge on average; 0 without faces.
    double area = 0.0;
    double mean_edge = 0.0;
};

double total_area(const PolygonMesh& mesh);

MeshSize size_of(const PolygonMesh& mesh);

}  // namespace seamflow
