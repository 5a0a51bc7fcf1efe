#pragma once

#include <optional>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Gaps of a small fraction of an edge in a surface, as between facets that were each transformed and rounded
/// separately.
struct Cracks {
    /// The number of boundary vertices that are within a hundredth of the median boundary edge of another boundary
    /// vertex, at a different position; and the largest distance of such a vertex from its nearest neighbour of this
    /// kind.
    Index n_vertices = 0;
    double width = 0.0;
    /// A distance for weld that closes the gaps, and the number of pairs of boundary edges that it joins.
    double weld_distance = 0.0;
    Index n_edges = 0;
};

/// Finds gaps.
/// @param topology of `mesh`. @returns nothing if no boundary vertices are near others, or if welding at weld_distance
/// joins no edges.
std::optional<Cracks> find_cracks(const PolygonMesh& mesh, const Topology& topology,
                                  const Executor& exec = run_serially);

/// A remark on the gaps for the user, with the distance for weld that closes them.
Remark remark_on_cracks(const Cracks& cracks);

}  // namespace seamflow
