#pragma once

#include <vector>

#include "partition/cut/face_graph.h"

namespace seamflow
{

/// Divides the nodes of a connected graph into k parts of about equal weight with short boundaries (METIS). The same
/// graph and k give the same parts each time. May be called from several threads, which then wait for each other.
/// @returns one label per node, from 0 to k - 1; on graphs of few nodes per part some labels may not occur, and a part
/// need not be connected.
/// @throws OptionError if k < 1, ComputationError if METIS fails.
std::vector<Index> metis_k_way(const FaceGraph& graph, Index k);

}  // namespace seamflow
