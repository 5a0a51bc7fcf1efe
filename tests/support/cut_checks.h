#pragma once

#include <optional>
#include <span>
#include <string>

#include "partition/cut/colouring.h"
#include "partition/topology.h"

/// What a cut has to be, found the slow way.
namespace seamflow::test {

/// Checks that every part is a manifold with boundary. It must be connected through edges, and at each vertex its
/// faces must form one run within each fan of the mesh. (An interior or ordinary boundary vertex has one fan; where the
/// mesh itself is pinched or has edges of three or more faces there are several, which no relabelling can join.)
/// @param labels #F, at least 0.
/// @returns a sentence about the first part or vertex that fails; nothing if all is well.
std::optional<std::string> first_defect(const PolygonMesh& mesh, const Topology& topology,
                                        std::span<const Index> labels);

/// The adjacency graph of the parts of a cut. Two are adjacent when they share a vertex of the interface Γ, that is a
/// vertex that moves and whose faces lie in two or more parts; those that are fixed do not count.
/// @param labels #F, from 0 to n_parts - 1.
Adjacency adjacency_of(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts);

}  // namespace seamflow::test
