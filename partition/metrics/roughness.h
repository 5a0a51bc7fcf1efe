#pragma once

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The roughness of a surface: angles in degrees, 0 where it is flat, 180 where it folds back onto itself. Smoothing
/// lowers them, noise and spikes raise them. A smooth curved surface has angles of about its curvature times the length
/// of an edge.
struct Roughness {
    /// The root mean square of all angles.
    double rms = 0.0;
    /// One angle in twenty is larger.
    double percentile_95 = 0.0;
};

/// Measures the angles between the triangles on both sides of an edge, over all edges of the mesh in triangles (see
/// fans_around_centres), including edges within a face: a polygon whose corners alternate up and down is rough,
/// although its vector area does not show it. Triangles without area, and positions that are not finite, are left out.
/// @param positions #V by 3, not necessarily those of the mesh.
Roughness roughness(const PolygonMesh& mesh, const Points& positions);

}  // namespace seamflow
