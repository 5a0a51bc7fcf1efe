#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh, or patches spread all over it if it is large, as a graph on which filters are tested.
struct FilterSample {
    /// The vertices, in ascending order.
    std::vector<Index> vertices;
    /// For each of them its neighbours along edges, as places among the vertices; none for those that stay fixed, such
    /// as rims of patches.
    IndexLists neighbours;
    /// The places of vertices that move and are far enough from rims of patches not to be affected.
    std::vector<Index> measured;
};

/// The whole mesh up to 30,000 vertices; else 32 patches of 18 rings of faces, measured within 8.
FilterSample take_filter_sample(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

/// The faces all of whose vertices are in a sample, ascending.
std::vector<Index> faces_of(const FilterSample& sample, const PolygonMesh& mesh, const Executor& exec = run_serially);

}  // namespace seamflow
