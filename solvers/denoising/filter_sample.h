#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh, or if it is large patches spread all over it, as a graph on which filters are tried out.
struct FilterSample {
    /// The vertices, in ascending order.
    std::vector<Index> vertices;
    /// For each of them its neighbours along edges, by their places among the vertices; none for those that stay where
    /// they are, as rims of patches do.
    IndexLists neighbours;
    /// The places of those vertices that move and are so far from rims of patches that these do not matter.
    std::vector<Index> measured;
};

/// The whole mesh up to 30,000 vertices; else 32 patches of 18 rings of faces, measured within 8.
FilterSample take_filter_sample(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

}  // namespace seamflow
