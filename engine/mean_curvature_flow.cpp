#include "engine/mean_curvature_flow.h"

#include "engine/flow.h"

namespace seamflow {

FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& options, const StepObserver& on_step,
                               const FlowControl& control)
{
    Flow flow(mesh, options, on_step, control);
    flow.step(options.steps - flow.n_steps());
    return flow.take_report();
}

}  // namespace seamflow
