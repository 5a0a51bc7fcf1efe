#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The vertices on the boundary or at junctions that move, ascending.
std::vector<Index> moving_rim(const PolygonMesh& mesh, const Topology& topology);

/// Checks that Γ does not meet a moving boundary, where conditions on Γ are not defined.
/// @param labels #F. @param vertices all vertices, or those to check.
/// @throws OptionError if Γ meets such a boundary at any of them.
void require_boundary_unshared(const Topology& topology, std::span<const Index> labels,
                               std::span<const Index> vertices);

}  // namespace seamflow
