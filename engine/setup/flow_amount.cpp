#include "engine/setup/flow_amount.h"

#include <cmath>

#include "engine/measure/smoothed_radius.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

double time_step_of(const FlowOptions& options, const PolygonMesh& mesh)
{
    return time_step_of(options.time_step, options.radius, options.steps, mesh, filter_of(options));
}

double uniform_edge_of(const FlowOptions& options, const PolygonMesh& mesh)
{
    if (options.laplacian != Laplacian::Uniform || options.uniform_edge > 0.0)
        return options.uniform_edge;
    const double edge = mean_edge_length(mesh, mesh.vertices);
    if (!std::isfinite(edge) && mesh.n_faces() > 0)
        require_valid(mesh);
    return std::isnormal(edge) ? edge : 1.0;
}

FlowOptions with_amount_on(const FlowOptions& options, const PolygonMesh& mesh)
{
    FlowOptions own = options;
    own.time_step = time_step_of(options, mesh);
    own.radius.reset();
    own.uniform_edge = uniform_edge_of(options, mesh);
    return own;
}

}  // namespace seamflow
