#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// The neighbours of each node, ascending, each in the other's list too.
using Adjacency = std::vector<std::vector<Index>>;

/// The adjacency graph of the parts of a cut. Two are adjacent when they share a vertex of the interface Γ, that is a
/// vertex that moves and whose faces lie in two or more parts; those that are fixed do not count.
/// @param labels #F, from 0 to n_parts - 1.
Adjacency adjacency_of(const PolygonMesh& mesh, const Topology& topology, std::span<const Index> labels, Index n_parts);

/// Colours the nodes so that neighbours differ: with two colours every connected component that allows it, the others
/// with few (the node whose neighbours have most colours first). Deterministic.
/// @returns one colour per node, from 0.
std::vector<Index> color(const Adjacency& adjacency);

/// The number of colours used: one more than the highest.
Index n_colors(std::span<const Index> colors);

}  // namespace seamflow
