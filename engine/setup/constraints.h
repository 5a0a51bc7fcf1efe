#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Holds the vertices fixed that the options name and those at which the flow is not defined.
/// @param topology of the mesh, as make_topology makes it.
/// @param remarks gets a sentence about those.
/// @throws InputError for a number in MotionOptions::fixed_vertices that is none of a vertex; for another number of
///         attachment weights than the mesh has vertices; with MotionOptions::strict naming
///         the first vertex, edge or face that the flow is not defined at; without it too if it is defined nowhere.
void constrain(Topology& topology, const PolygonMesh& mesh, const FlowOptions& options, const Executor& exec,
               std::vector<std::string>& remarks);

/// The vertices on the boundary that move.
std::vector<Index> moving_boundary(const PolygonMesh& mesh, const Topology& topology);

/// The conditions on Γ are not defined where Γ meets a boundary that moves.
/// @param labels #F. @param vertices all, or those that are asked about.
/// @throws OptionError if it does at one of them.
void require_boundary_unshared(const Topology& topology, std::span<const Index> labels,
                               std::span<const Index> vertices);

}  // namespace seamflow
