#include "samples/runs/step_results.h"

#include "engine/tasks/stopwatch.h"
#include "samples/report/report_text.h"

namespace seamflow {

StepObserver show_and_write_steps(const SmoothCommand& command, const std::optional<MeshOutput>& steps,
                                  const PolygonMesh& input, double mean_edge, double& write_seconds,
                                  std::optional<PageFlow>& page, std::ostream& out, const Executor& exec)
{
    PolygonMesh snapshot = steps ? input : PolygonMesh{};
    return [&command, &steps, &write_seconds, &page, &out, &exec, mean_edge, snapshot](const StepState& state) mutable {
        if (command.verbose)
            print_step(out, state.report, state.step, command.options.steps, mean_edge);
        if (page)
            page->add_step(state.step, state.positions, state.reference_positions);
        if (!steps)
            return;
        const Stopwatch watch;
        if (state.separated == nullptr)
            snapshot.vertices = state.positions;
        steps->write_as(command.every_step->path(state.step), snapshot, state.separated, exec);
        write_seconds += watch.seconds();
    };
}

}  // namespace seamflow
