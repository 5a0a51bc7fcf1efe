#pragma once

#include "engine/denoise.h"
#include "engine/mean_curvature_flow.h"
#include "partition/openmesh.h"

namespace seamflow {

/// Calls move(mesh, options), with vertices fixed by their status, and then copies the positions to the mesh, also
/// after an exception.
template <OpenMeshMesh Mesh, class Options, class Move>
auto move_openmesh(Mesh& mesh, Options options, Move&& move)
{
    PolygonMesh moving = to_polygon_mesh(mesh);
    const std::vector<Index> held = held_by_status(mesh);
    options.motion.fixed_vertices.insert(options.motion.fixed_vertices.end(), held.begin(), held.end());
    try {
        auto report = move(moving, options);
        set_positions(mesh, moving.vertices);
        return report;
    } catch (...) {
        set_positions(mesh, moving.vertices);
        throw;
    }
}

/// Smooths an OpenMesh mesh: see mean_curvature_flow for a PolygonMesh. Points are computed in double precision,
/// whatever the mesh's scalar type, and rounded once at the end. The mesh's other properties (also normals) do not
/// change. Locked vertices and MotionOptions::fixed_vertices do not move; if any vertex is selected, unselected
/// vertices do not move either (see held_by_status).
template <OpenMeshMesh Mesh>
FlowReport mean_curvature_flow(Mesh& mesh, const FlowOptions& options, const StepObserver& on_step = {},
                               const FlowControl& control = {})
{
    return move_openmesh(mesh, options, [&](PolygonMesh& moving, const FlowOptions& with_status) {
        return mean_curvature_flow(moving, with_status, on_step, control);
    });
}

/// Removes the noise of an OpenMesh mesh: see denoise for a PolygonMesh, and mean_curvature_flow for the mesh.
template <OpenMeshMesh Mesh>
DenoiseReport denoise(Mesh& mesh, const DenoiseOptions& options = {}, const StepObserver& on_step = {},
                      const FlowControl& control = {})
{
    return move_openmesh(mesh, options, [&](PolygonMesh& moving, const DenoiseOptions& with_status) {
        return denoise(moving, with_status, on_step, control);
    });
}

}  // namespace seamflow
