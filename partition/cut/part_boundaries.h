#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/repair/repair.h"
#include "partition/topology.h"

namespace seamflow {

/// Shortens the boundaries of parts, which initially follow the outlines of clusters: face by face, each moves to the
/// part across most of its edges if this cuts fewer edges, or as many and the two parts then differ less in weight (see
/// face_weight). No part becomes too heavy (see balance_tolerance) or as much too light by this; a part that is too
/// heavy or too light exchanges faces with its neighbours even if this cuts one edge more. Parts may become pinched or
/// disconnected (see repair).
/// @param labels #F, from 0 to n_labels - 1; no face is moved into another connected component.
/// @returns the parts and faces that may have defects now, if all parts were connected before.
SuspectedDefects shorten_boundaries(const PolygonMesh& mesh, const Topology& topology, Index n_labels,
                                    std::vector<Index>& labels, const Executor& exec = run_serially);

}  // namespace seamflow
