#include "engine/setup/resolved_options.h"

#include <cmath>
#include <utility>

#include "engine/measure/length_scale.h"
#include "engine/motion/resolved_motion.h"

namespace seamflow {

FlowOptions resolved(FlowOptions options, const PolygonMesh& mesh, LengthScale& scale, const Executor& exec,
                     std::vector<Remark>& remarks)
{
    options.motion = resolved(std::move(options.motion), mesh, scale, exec, remarks);
    options.time_step = time_step_of(options, scale);
    options.time_step_edges.reset();
    options.radius.reset();
    if (options.laplacian == Laplacian::Uniform && !(options.uniform_edge > 0.0))
        options.uniform_edge = std::isnormal(scale.mean_edge()) ? scale.mean_edge() : 1.0;
    return options;
}

FlowOptions resolved(FlowOptions options, const PolygonMesh& mesh)
{
    LengthScale scale(mesh);
    std::vector<Remark> remarks;
    return resolved(std::move(options), mesh, scale, run_serially, remarks);
}

double time_step_of(const FlowOptions& options, LengthScale& scale)
{
    return time_step_of({options.time_step, options.time_step_edges, options.radius}, options.steps, scale,
                        filter_of(options));
}

}  // namespace seamflow
