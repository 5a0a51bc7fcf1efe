#pragma once

#include <algorithm>
#include <vector>

#include "partition/metrics/vertex_distance.h"
#include "samples/common/meshes.h"
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
        kind.options.threads = threads;
        kind.options.subdomains = std::min(kind.options.subdomains, Index{3});
        if (!kind.options.fixed_vertices.empty())
            kind.options.fixed_vertices = {3, 50, 51, 60};
    }
    FlowKind little_memory{"converged in little memory", kinds.front().options};
    little_memory.options.tolerance = 1e-3;
    little_memory.options.memory_limit = least_memory_limit(small_mesh(), little_memory.options).value();
    kinds.push_back(little_memory);
    return kinds;
}

}  // namespace seamflow::test
