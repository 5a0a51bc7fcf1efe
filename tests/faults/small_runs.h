#pragma once

#include <algorithm>
#include <vector>

#include "partition/metrics/vertex_distance.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flow_kinds.h"
#include "tests/support/memory_limits.h"

namespace seamflow::test {

/// About a hundred vertices, polygons of several kinds.
inline PolygonMesh small_mesh()
{
    return make_mixed_polygons(100);
}

/// flow_kinds for it, in three sub-meshes.
inline std::vector<FlowKind> small_flows(int steps, int threads)
{
    auto kinds = flow_kinds(mean_edge_length(small_mesh()));
    for (FlowKind& kind : kinds) {
        kind.options.steps = steps;
        kind.options.resources.threads = threads;
        kind.options.cut.subdomains = std::min(kind.options.cut.subdomains, Index{3});
        if (!kind.options.motion.fixed_vertices.empty())
            kind.options.motion.fixed_vertices = {3, 50, 51, 60};
    }
    FlowKind little_memory{"converged in little memory", kinds.front().options};
    little_memory.options.accuracy.tolerance = 1e-3;
    little_memory.options.resources.memory_limit = least_memory_limit(small_mesh(), little_memory.options).value();
    kinds.push_back(little_memory);
    return kinds;
}

}  // namespace seamflow::test
