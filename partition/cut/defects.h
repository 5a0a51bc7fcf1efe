#pragma once

#include <optional>
#include <span>
#include <string>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow
{

/// Checks that every part is a manifold with boundary. It must be connected through edges, and at each vertex its
/// faces must form one fan within each umbrella of the mesh. (An umbrella is a fan of the whole mesh. An interior or
/// ordinary boundary vertex has one; where the mesh itself is pinched or has edges of three or more faces there are
/// several, which no relabelling can join.)
/// @param labels #F, at least 0.
/// @returns a sentence about the first part or vertex that fails; nothing if all is well.
std::optional<std::string> first_defect(const PolygonMesh& mesh, const Topology& topology,
                                        std::span<const Index> labels);

}  // namespace seamflow
