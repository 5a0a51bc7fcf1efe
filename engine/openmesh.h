#pragma once

#include "engine/mean_curvature_flow.h"
#include "partition/openmesh.h"

namespace seamflow {

/// Smooths a mesh of OpenMesh: see mean_curvature_flow for a PolygonMesh. Points are computed in double precision,
/// whatever the mesh's own scalar is, and rounded once at the end. The mesh's other properties (normals, too) stay as
/// they are. Vertices that are locked stay; so do, where any vertex is selected, all that are not (see held_by_status);
/// MotionOptions::fixed_vertices stay besides.
template <OpenMeshMesh Mesh>
FlowReport mean_curvature_flow(Mesh& mesh, const FlowOptions& options, const StepObserver& on_step = {},
                               const FlowControl& control = {})
{
    PolygonMesh flowing = to_polygon_mesh(mesh);
    FlowOptions with_status = options;
    const std::vector<Index> held = held_by_status(mesh);
    with_status.motion.fixed_vertices.insert(with_status.motion.fixed_vertices.end(), held.begin(), held.end());
    try {
        FlowReport report = mean_curvature_flow(flowing, with_status, on_step, control);
        set_positions(mesh, flowing.vertices);
        return report;
    } catch (...) {
        set_positions(mesh, flowing.vertices);
        throw;
    }
}

}  // namespace seamflow
