#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The vertices on the boundary or at junctions that move, ascending.
std::vector<Index> moving_rim(const PolygonMesh& mesh, const Topology& topology);

/// Checks that no moving vertex of the boundary or of a junction is on Γ, where conditions on Γ are not defined.
/// @param labels #F. @param vertices the vertices to check (see moving_rim).
/// @throws OptionError if any of them is on Γ.
void require_boundary_unshared(const Topology& topology, std::span<const Index> labels,
                               std::span<const Index> vertices);

}  // namespace seamflow
