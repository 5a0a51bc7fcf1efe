#pragma once

#include <span>

#include <Eigen/Core>

#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Distances along the surface from some vertices, by the heat method (Crane, Weischedel and Wardetzky, Geodesics in
/// Heat, 2013), for any polygons: heat diffuses from them for a short time, and the distance is the function whose
/// gradient comes nearest to the directions in which the heat decreases, by length 1. Two factorisations of the whole
/// mesh, with the Laplacian of virtual vertices (Δ_B). Where an edge is long or a triangle has a very obtuse angle, it
/// is less accurate; on good meshes it is so to about the part of an edge length.
/// @param from vertices, in any order.
/// @param resources threads.
/// @returns #V: in length; 0 for the vertices themselves, infinite where the surface does not lead from any of them.
///          Along seams (see weld) surfaces continue.
/// @throws InputError for a mesh that cannot be used, for no vertices, and for those that do not exist; for distances
///         beyond the largest number; as
///         mean_curvature_flow.
Eigen::VectorXd geodesic_distance(const PolygonMesh& mesh, std::span<const Index> from,
                                  const ResourceOptions& resources = {}, const FlowControl& control = {});

}  // namespace seamflow
