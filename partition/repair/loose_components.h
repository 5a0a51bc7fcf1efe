#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// Makes parts connected through edges: each part keeps its largest connected component (of equals the one with the
/// lowest face); every other component moves to the neighbouring part with which it shares the longest boundary.
/// @param suspects one entry per label: the parts to check; other parts are assumed to be connected.
/// @param labels #F, in the range of `suspects`; no part may lie in several connected components of the mesh.
/// @returns the faces that changed their label.
std::vector<Index> join_loose_components(const PolygonMesh& mesh, const Topology& topology,
                                         const std::vector<bool>& suspects, std::vector<Index>& labels,
                                         const Executor& exec = run_serially);

/// Gives a part that lies in several connected components of the mesh a label for each of them: the first
/// component keeps the label, the others get new ones.
/// @param labels #F, from 0 to n_labels - 1.
/// @returns the new number of labels.
Index split_by_component(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels);

}  // namespace seamflow
