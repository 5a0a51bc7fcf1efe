#pragma once

#include "engine/options/flow_options.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow::test {

/// Steps so long that Δ_F shrinks edges of irregular meshes to nothing; how they are taken is left open.
inline FlowOptions collapsing_flow(const PolygonMesh& mesh)
{
    FlowOptions options;
    const double edge = mean_edge_length(mesh);
    options.time_step = 5.0 * edge * edge;
    options.steps = 7;
    return options;
}

}  // namespace seamflow::test
