#pragma once

#include <vector>

#include "engine/options/motion_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Lets the boundary and junctions move, if the options say so. Fixes the vertices that the options name, and those at
/// which the Laplacian is not defined.
/// @param topology of the mesh, as make_topology makes it.
/// @param has_lengths whether all edges are known to have a length that is a normal double.
/// @param remarks gets a sentence about vertices at which the flow is not defined.
/// @throws InputError for a number in MotionOptions::fixed_vertices that is not a vertex; if there are not as many
///         attachment weights or strengths as vertices; with MotionOptions::strict, naming the first vertex, edge or
///         face at which the flow is not defined; also without it if the flow is defined nowhere.
void constrain(Topology& topology, const PolygonMesh& mesh, const MotionOptions& motion, Laplacian laplacian,
               bool has_lengths, const Executor& exec, std::vector<Remark>& remarks);

}  // namespace seamflow
