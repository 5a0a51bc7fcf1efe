#pragma once

#include <vector>

#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Merges pairs of neighbouring parts at pinched vertices, the smaller into the larger, until no vertex is pinched.
/// Connected parts stay connected, and each round leaves fewer: at worst there is one part for each connected component
/// of the mesh.
/// @param labels #F, from 0 to n_labels - 1; labels of parts that are merged into others no longer occur.
void merge_pinched(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels);

}  // namespace seamflow
