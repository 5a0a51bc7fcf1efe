#include "engine/mean_curvature_flow.h"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/flow_run.h"
#include "engine/options/valid_options.h"
#include "engine/setup/flowing_mesh.h"
#include "engine/setup/prepared_flow.h"
#include "engine/setup/smoothed_radius.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "engine/tasks/workers.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// Setup takes about as long as so many steps.
double fraction_of_setup(const FlowOptions& options, const FlowState* resume)
{
    const bool is_simple = options.scheme == Scheme::ExplicitEuler || options.keep_edges;
    const double as_steps = options.accuracy.tolerance ? 4.0 : is_simple ? 3.0 : 6.0;
    const double to_do = options.steps - (resume != nullptr ? resume->n_steps() : 0);
    return as_steps / (as_steps + to_do);
}

/// @throws OptionError if the state is beyond the last step that is wanted.
void require_ahead(const FlowOptions& options, const FlowState& state)
{
    if (state.n_steps() > options.steps)
        throw OptionError(fmt::format("steps is {}, but the state to resume from is already after step {}: ask for at "
                                      "least as many, or start over",
                                      options.steps, state.n_steps()));
}

}  // namespace

FlowReport mean_curvature_flow(PolygonMesh& mesh, const FlowOptions& asked, const StepObserver& on_step,
                               const FlowControl& control)
{
    require_valid(asked);
    FlowOptions options = asked;
    options.time_step = time_step_of(asked, mesh);
    options.radius.reset();
    options.uniform_edge = uniform_edge_of(asked, mesh);
    const FlowState* const resume = control.resume.get();
    if (resume != nullptr)
        require_ahead(options, *resume);
    FlowReport report;
    Workers workers(options.resources.threads);
    workers.execute([&] {
        Stopwatch watch;
        Progress progress(control);
        progress.set_steps(options.steps);
        const double setup = fraction_of_setup(options, resume);
        progress.enter(FlowPhase::Cut, 0, 0.0, 0.6 * setup);
        progress.expect(8.0);
        FlowingMesh flowing(mesh);
        auto prepared = prepare(flowing, options, static_cast<bool>(on_step), resume, progress);
        report.resources.threads = workers.threads();
        report.seconds.cut = watch.lap();
        FlowRun run(flowing, std::move(prepared), progress, setup, report);
        run.take_steps(on_step, resume);
    });
    return report;
}

}  // namespace seamflow
