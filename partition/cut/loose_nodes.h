#pragma once

#include <vector>

#include "partition/cut/face_graph.h"

namespace seamflow {

/// Makes the parts of a divided graph connected: each keeps its heaviest connected component (of equals the first), and
/// every other one goes to the neighbouring part to which its arcs weigh most.
/// @param labels #nodes, from 0 to n_labels - 1; no part may have nodes in several connected components of the graph.
/// @returns whether a part had several.
bool join_loose_nodes(const FaceGraph& graph, Index n_labels, std::vector<Index>& labels);

}  // namespace seamflow
