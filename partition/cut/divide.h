#pragma once

#include <vector>

#include "partition/cut/face_graph.h"
#include "partition/cut/metis.h"

namespace seamflow {

/// Divides the nodes of a graph into k parts of about equal weight with short boundaries, in stages: into a few groups
/// of parts, and those further. METIS asked for many parts at once takes several times as long. The same graph and k
/// give the same parts each time.
/// @returns one label per node; every part lies within one component, so that there are at least as many as
///          components. As with metis_k_way labels may be missing, and parts need not be connected.
/// @throws ComputationError if METIS fails.
std::vector<Index> divide(const FaceGraph& graph, const Components& components, Index k,
                          Afterwards afterwards = Afterwards::Nothing);

}  // namespace seamflow
