#pragma once

#include <cstdint>
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

/// Data of the whole mesh that a piece of it needs.
struct BoundarySurroundings {
    /// One entry per label: the weight of the part in the whole mesh.
    std::vector<std::int64_t> weights;
    /// #F of the piece: 1 where a face keeps its label, as faces with neighbours outside do.
    std::vector<std::uint8_t> held;
};

/// The same within a piece of a mesh.
SuspectedDefects shorten_boundaries(const PolygonMesh& piece, const Topology& topology,
                                    const BoundarySurroundings& whole, std::vector<Index>& labels,
                                    const Executor& exec = run_serially);

}  // namespace seamflow
