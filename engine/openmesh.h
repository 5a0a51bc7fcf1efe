#pragma once

#include "engine/mean_curvature_flow.h"
#include "partition/openmesh.h"

namespace seamflow {

/// Smooths an OpenMesh mesh: see mean_curvature_flow for a PolygonMesh. Points are computed in double precision,
/// whatever the mesh's scalar type, and rounded once at the end. The mesh's other properties (also normals) do not
/// change. Locked vertices and MotionOptions::fixed_vertices do not move; if any vertex is selected, unselected
/// vertices do not move either (see held_by_status).
template <OpenMeshMesh Mesh>
FlowReport mean_curvature_flow(Mesh& mesh, const FlowOptions& options = FlowOptions::denoising(),
                               const StepObserver& on_step = {}, const FlowControl& control = {})
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
