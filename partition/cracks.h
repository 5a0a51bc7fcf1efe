#pragma once

#include <optional>

#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"
#include "partition/topology.h"

namespace seamflow {

/// Places where a surface is open by a small fraction of an edge, as where each facet was transformed and rounded by
/// itself.
struct Cracks {
    /// Vertices on the boundary near another one that is at another place, and the largest distance of such a vertex
    /// from the nearest other.
    Index n_vertices = 0;
    double width = 0.0;
    /// A distance for weld, and how many pairs of boundary edges it joins then.
    double weld_distance = 0.0;
    Index n_edges = 0;
};

/// @param topology of `mesh`. @returns nothing if no boundary vertices are near others, or if no distance joins them.
std::optional<Cracks> find_cracks(const PolygonMesh& mesh, const Topology& topology,
                                  const Executor& exec = run_serially);

/// What joins them.
Remark remark_on_cracks(const Cracks& cracks);

}  // namespace seamflow
