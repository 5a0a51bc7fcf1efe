#pragma once

#include "partition/executor.h"
#include "partition/topology.h"
#include "solvers/normals/feature_lines.h"
#include "solvers/normals/normal_diffusion.h"

namespace seamflow {

/// Smooths a surface and keeps its edges: several times, face normals diffuse by a fraction of the time step, but not
/// across edges, and vertices move to fit them.
/// @param topology twins are not used. @param lines of the mesh. @param diffusion of the mesh, cut open along the
/// lines.
/// @param time_step in length². @param angle between the normals of faces, in degrees: sharper edges stay.
/// @param positions #V by 3.
/// @returns #V by 3.
Points smoothed_between_edges(const PolygonMesh& mesh, const Topology& topology, const FeatureLines& lines,
                              NormalDiffusion& diffusion, const Points& positions, double time_step, double angle,
                              const Executor& exec = run_serially);

}  // namespace seamflow
