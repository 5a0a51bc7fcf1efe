#include "samples/common/flow_run.h"

#include <algorithm>

#include <fmt/format.h>

#include "partition/metrics/noise.h"
#include "partition/topology.h"
#include "samples/common/noise_removal.h"

namespace seamflow {

namespace {

/// Turns an amount that depends on the noise of the mesh into one that does not.
void resolve_noise(SmoothCommand& command, const PolygonMesh& mesh, const Loop& loop, RunRecord& run)
{
    if (!command.amount.slope_of_noise)
        return;
    run.noise =
        run.scale.mean_edge > 0.0 ? estimate_noise(mesh, make_topology(mesh, loop), loop) / run.scale.mean_edge : 0.0;
    const double edges =
        time_step_edges_for_noise(*run.noise, *command.amount.slope_of_noise, command.options.filter == Filter::LowPass,
                                  std::max(command.options.steps, 1));
    command.amount = {.time_step_edges = edges};
}

/// Where the amount depends on the noise of the mesh, no more is taken off it.
void stay_within_noise(SmoothCommand& command, const PolygonMesh& mesh, const Loop& loop, const RunRecord& run)
{
    if (!run.noise)
        return;
    const double within = time_step_within_noise(mesh, *run.noise * run.scale.mean_edge, command.options, loop) /
                          command.options.time_step;
    // What is printed of it is to be all of it.
    const double edges = std::stod(fmt::format("{:.3g}", within * *command.amount.time_step_edges));
    command.amount.time_step_edges = edges;
    command.options.time_step = time_step_of(command.amount, run.scale, command.options.steps);
    command.chosen += fmt::format("--time-step-edges {}", edges);
}

}  // namespace

RunRecord begin_record(const SmoothCommand& command)
{
    return {.input = command.input.string(),
            .output = command.output.string(),
            .arguments = command.arguments,
            .laplacian = std::string(name_of(command.options.laplacian)),
            .flow = command.options.flow,
            .filter = command.options.filter,
            .rescale = command.options.motion.rescale,
            .keep_edges = command.options.keep_edges,
            .preset = command.preset};
}

void resolve_amount(SmoothCommand& command, const PolygonMesh& mesh, const Loop& loop, RunRecord& run)
{
    run.scale = measure_scale(mesh, loop);
    resolve_noise(command, mesh, loop, run);
    MotionOptions& motion = command.options.motion;
    if (command.attach)
        motion.attachment = attachment_of(*command.attach, run.scale);
    command.options.time_step = time_step_of(command.amount, run.scale, command.options.steps);
    stay_within_noise(command, mesh, loop, run);
    if (motion.attachment > 0.0)
        run.attachment = motion.attachment;
    run.has_attachment_weights = !motion.attachment_weights.empty();
}

void remark_on_loss(const FlowOptions& options, const SurfaceChange& change, std::vector<std::string>& remarks)
{
    constexpr double much = 0.2;
    if (!change.before.volume || !change.after.volume || options.motion.rescale != Rescale::None)
        return;
    const double lost = 1.0 - *change.after.volume / *change.before.volume;
    if (lost > much)
        remarks.push_back(fmt::format("The surface has lost {:.0f}% of its volume: --filter low-pass loses less, "
                                      "--rescale volume scales it back, and less smoothing is gentler.",
                                      100.0 * lost));
}

std::string missed_tolerance(const SmoothCommand& command, const FlowReport& report)
{
    const int missed = steps_failed(command, report);
    if (missed == 0)
        return {};
    return fmt::format("the tolerance {} was missed in {} {}", *command.options.accuracy.tolerance, missed,
                       missed == 1 ? "step" : "steps");
}

}  // namespace seamflow
