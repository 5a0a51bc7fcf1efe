#pragma once

#include <cstdint>
#include <vector>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/repair/repair.h"
#include "partition/topology.h"

namespace seamflow {

/// Shortens the seams between parts, which at first follow the outlines of clusters: face by face, each goes to the
/// part across most of its edges if fewer edges are cut then, or as many and the two parts differ less in weight (see
/// face_weight). No part becomes too heavy (see balance_tolerance) or as much too light by this; a part that is either
/// exchanges faces with its neighbours even where one edge more is cut. Parts may come out pinched or not connected
/// (see repair).
/// @param labels #F, from 0 to n_labels - 1; none is carried into another connected component.
/// @returns where defects may be now if all parts were connected before.
SuspectedDefects shorten_boundaries(const PolygonMesh& mesh, const Topology& topology, Index n_labels,
                                    std::vector<Index>& labels, const Executor& exec = run_serially);

/// What a piece of a mesh has to know of the whole.
struct BoundarySurroundings {
    /// One entry per label: the weight of the part in the whole mesh.
    std::vector<std::int64_t> weights;
    /// #F of the piece: 1 where a face keeps its label, as those do that have neighbours outside.
    std::vector<std::uint8_t> held;
};

/// The same within a piece of a mesh.
SuspectedDefects shorten_boundaries(const PolygonMesh& piece, const Topology& topology,
                                    const BoundarySurroundings& whole, std::vector<Index>& labels,
                                    const Executor& exec = run_serially);

}  // namespace seamflow
