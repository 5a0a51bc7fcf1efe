#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/repair/repair.h"
#include "partition/topology.h"

namespace seamflow {

/// Shortens the boundaries of parts, which initially follow the outlines of clusters: face by face, each goes to the
/// part across most of its edges if this cuts fewer edges, or as many and the two parts differ less in weight (see
/// face_weight). This makes no part too heavy (see balance_tolerance) or as much too light; a part that is either
/// exchanges faces with its neighbours even where this cuts one edge more. Parts may become pinched or disconnected
/// (see repair).
/// @param labels #F, from 0 to n_labels - 1; none is carried into another connected component.
/// @returns where defects may be now if all parts were connected before.
SuspectedDefects shorten_boundaries(const PolygonMesh& mesh, const Topology& topology, Index n_labels,
                                    std::vector<Index>& labels, const Executor& exec = run_serially);

}  // namespace seamflow
