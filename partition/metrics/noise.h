#pragma once

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Estimates the noise of a mesh from itself: the standard deviation of its vertices from the surface, along the
/// normals. Quadratic height functions are fitted to two and to three rings around a vertex, without the vertex (least
/// squares, over the plane that fits two rings best); its distances from them, corrected for the noise of the fit, are
/// its residuals.
/// - Noise is equally large everywhere, shape is not: only the smoothest of about five hundred evenly spread
///   neighbourhoods count (Liu, Tanaka, Okutomi, Single-Image Noise Level Estimation, 2013). One half of the vertices
///   of a neighbourhood gives its smoothness, the other half its residuals, so that the choice does not favour small
///   noise. Edges, corners and spikes do not count as long as smooth neighbourhoods are left.
/// - Noise is independent from vertex to vertex: its residuals do not grow with the rings, and those of neighbours are
///   correlated as the fits make them. Shape grows, or bends neighbours alike. What grows is subtracted; where it grows
///   as for shape alone, or neighbours are bent alike, the noise is 0.
/// - Noise spares no vertex: where many are on their fits, the noise is 0.
///
/// Costs the same for all large meshes, except for the mean edge.
/// @returns in units of length; 0 if noise is not proved: on meshes of fewer than 200 vertices with rings to fit to, if
/// the estimate is above a third of the mean edge (as for noise of half the true mean edge), and if it is below a
/// hundredth of it, where it hardly shows: it bends faces by about a degree.
double estimate_noise(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

}  // namespace seamflow
