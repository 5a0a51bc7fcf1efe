#include "samples/options/smooth_surface.h"

#include <utility>

#include "engine/denoise.h"
#include "engine/denoise/denoise_identity.h"
#include "engine/mean_curvature_flow.h"
#include "engine/state/flow_identity.h"

namespace seamflow {

SmoothReport report_of(DenoiseReport report, Index n_faces)
{
    SmoothReport all;
    all.noise = report.noise;
    all.rounding = report.rounding;
    all.time_step = report.time_step;
    all.resources.threads = report.threads;
    all.cut.labels.assign(n_faces, 0);
    if (n_faces > 0)
        all.cut.sub_meshes = {{.faces = static_cast<Index>(report.mesh.faces - std::ssize(report.mesh.repeated_faces)),
                               .vertices = static_cast<Index>(report.mesh.vertices)}};
    static_cast<RunReport&>(all) = std::move(report);
    return all;
}

SmoothReport smooth_surface(PolygonMesh& mesh, const AllOptions& options, const StepObserver& on_step,
                            const FlowControl& control)
{
    if (options.takes_whole_mesh())
        return report_of(denoise(mesh, denoise_options_of(options), on_step, control), mesh.n_faces());
    return mean_curvature_flow(mesh, options, on_step, control);
}

std::uint64_t identity_of(const PolygonMesh& mesh, const AllOptions& options)
{
    return options.takes_whole_mesh() ? identify(mesh, denoise_options_of(options)) : identify(mesh, options);
}

}  // namespace seamflow
