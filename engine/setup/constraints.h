#pragma once

#include <span>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Lets the boundary and junctions move, if the options say so. Fixes the vertices that the options name, and those at
/// which the flow is not defined.
/// @param topology of the mesh, as make_topology makes it.
/// @param has_lengths whether all edges are known to have a length that is a normal double.
/// @param remarks gets a sentence about vertices at which the flow is not defined.
/// @throws InputError for a number in MotionOptions::fixed_vertices that is not a vertex; if there are not as many
///         attachment weights or strengths as vertices; with MotionOptions::strict, naming the first vertex, edge or
///         face at which the flow is not defined; also without it if the flow is defined nowhere.
void constrain(Topology& topology, const PolygonMesh& mesh, const FlowOptions& options, bool has_lengths,
               const Executor& exec, std::vector<Remark>& remarks);

/// The vertices on the boundary or at junctions that move, ascending.
std::vector<Index> moving_rim(const PolygonMesh& mesh, const Topology& topology);

/// Checks that Γ does not meet a moving boundary, where conditions on Γ are not defined.
/// @param labels #F. @param vertices all vertices, or those to check.
/// @throws OptionError if Γ meets such a boundary at any of them.
void require_boundary_unshared(const Topology& topology, std::span<const Index> labels,
                               std::span<const Index> vertices);

}  // namespace seamflow
