#pragma once

#include <vector>

#include "partition/executor.h"
#include "partition/index_lists.h"
#include "partition/polygon_mesh.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh as a graph on which filters are tried; of a large mesh, patches spread all over it.
struct FilterSample {
    /// The numbers of the vertices in the mesh, ascending.
    std::vector<Index> vertices;
    /// For each vertex of the sample, its neighbours along edges, as indices in `vertices`. Vertices that do not move,
    /// such as vertices at rims of patches, have no neighbours.
    IndexLists neighbours;
    /// The indices in `vertices` of vertices that move and are too far from rims of patches to be affected by them: at
    /// these, results of filters are measured.
    std::vector<Index> measured;
};

/// Takes the whole mesh if it has up to 30,000 vertices; otherwise 32 patches of 18 rings of faces, measured within 8
/// rings.
FilterSample take_filter_sample(const PolygonMesh& mesh, const Topology& topology, const Executor& exec = run_serially);

/// The faces whose vertices are all in a sample, ascending.
std::vector<Index> faces_of(const FilterSample& sample, const PolygonMesh& mesh, const Executor& exec = run_serially);

}  // namespace seamflow
