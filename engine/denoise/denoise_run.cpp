#include "engine/denoise/denoise_run.h"

#include <variant>

#include "engine/denoise/denoising_stepper.h"
#include "engine/denoise/edge_keeping_stepper.h"
#include "engine/denoise/rim_stepper.h"
#include "engine/measure/surface_measures.h"
#include "engine/tasks/stopwatch.h"

namespace seamflow {

namespace {

/// Makes the stepper of a method.
struct MakeStepper {
    const PolygonMesh& mesh;
    const Topology& topology;
    const DenoiseOptions& options;
    Progress& progress;

    std::unique_ptr<WholeMeshStepper> operator()(const RemoveNoise& method) const
    {
        return std::make_unique<DenoisingStepper>(mesh, topology, options.motion, method, progress);
    }
    std::unique_ptr<WholeMeshStepper> operator()(const SmoothBetweenEdges& method) const
    {
        return std::make_unique<EdgeKeepingStepper>(mesh, topology, options.motion, method.edge_angle,
                                                    method.amount.time_step, progress);
    }
    std::unique_ptr<WholeMeshStepper> operator()(const SmoothRims& method) const
    {
        return std::make_unique<RimStepper>(mesh, topology, options.motion, method.amount.time_step, options.steps,
                                            progress);
    }
};

/// The Laplacian of the mean curvatures in the report.
constexpr Laplacian laplacian_of_report = Laplacian::Fujiwara;

}  // namespace

DenoiseRun::DenoiseRun(Surface& surface, const DenoiseOptions& options, std::uint64_t identity, double setup,
                       Progress& progress, DenoiseReport& report, const FlowControl& control)
    : SurfaceRun(surface, progress, report, control.resume.get())
    , identity_(identity)
{
    const Stopwatch watch;
    const PolygonMesh& flowing = mesh_.mesh();
    if (options.measures)
        measure_by(DisplacementMeter(flowing, surface.topology), laplacian_of_report,
                   measure_largest_curvature(flowing, surface.topology, flowing.vertices, laplacian_of_report));
    progress.enter(FlowPhase::Analyse, 0, 0.6 * setup, setup);
    stepper_ = std::visit(MakeStepper{flowing, surface.topology, options, progress}, options.method);
    report.seconds.analyse = watch.seconds();
    report.seconds.total = report.seconds.cut + report.seconds.analyse;
    // In diagonals of the bounding box.
    constexpr double largest_update = 1.0;
    begin(options.motion, false, largest_update, setup, options.steps);
}

FlowState DenoiseRun::capture() const
{
    FlowState state = SurfaceRun::capture();
    state.identity = identity_;
    return state;
}

void DenoiseRun::complete(DenoiseReport& report) const
{
    remark_on_constraints(report);
    report_measures(report);
    stepper_->report_to(report);
    mesh_.complete(report);
}

}  // namespace seamflow
