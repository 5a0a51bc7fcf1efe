#pragma once

#include "partition/topology.h"
#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// Takes the steps of a task by CGAL's smooth_shape, one call per step, so that its cotangent weights follow the mesh.
/// A step is that of Alexa-Wardetzky on triangles, whatever the Laplacian of the task, with the same vertices held
/// fixed as in ours; a mesh with fewer than two fixed vertices is also scaled back to its volume after each step.
/// Positions are only returned if the task's equations were solved.
/// @throws ComputationError unless all faces are triangles, oriented alike and form a manifold.
MethodResult run_smooth_shape(const PolygonMesh& mesh, const MethodTask& task);

}  // namespace seamflow
