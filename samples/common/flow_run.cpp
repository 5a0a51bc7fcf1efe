#include "samples/common/flow_run.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "partition/metrics/noise.h"
#include "partition/topology.h"
#include "partition/weld.h"
#include "samples/common/noise_removal.h"

namespace seamflow {

namespace {

/// Turns an amount that depends on the noise of the mesh into one that does not.
void resolve_noise(SmoothCommand& command, const PolygonMesh& mesh, const Topology& topology, const Loop& loop,
                   RunRecord& run)
{
    run.noise = run.scale.mean_edge > 0.0 ? estimate_noise(mesh, topology, loop) / run.scale.mean_edge : 0.0;
    const double edges =
        time_step_edges_for_noise(*run.noise, *command.amount.slope_of_noise, command.options.filter == Filter::LowPass,
                                  std::max(command.options.steps, 1));
    command.amount = {.time_step_edges = edges};
}

/// No more is taken off the mesh than its noise.
void stay_within_noise(SmoothCommand& command, const PolygonMesh& mesh, const Loop& loop, const RunRecord& run)
{
    const double within = time_step_within_noise(mesh, *run.noise * run.scale.mean_edge, command.options, loop) /
                          command.options.time_step;
    // What is printed of it is to be all of it.
    const double edges = std::stod(fmt::format("{:.3g}", within * *command.amount.time_step_edges));
    command.amount.time_step_edges = edges;
    command.options.time_step =
        time_step_of(command.amount, run.scale, command.options.steps, filter_of(command.options));
    command.chosen += fmt::format("--time-step-edges {}", edges);
}

/// Chooses the amount by the noise of the mesh as it flows.
void resolve_by_noise(SmoothCommand& command, const PolygonMesh& mesh, const Loop& loop, RunRecord& run)
{
    const Topology topology = make_topology(mesh, loop);
    const std::optional<double> within = command.options.motion.weld;
    const std::optional<Weld> welded = within ? weld(mesh, topology, *within, loop) : std::nullopt;
    const PolygonMesh& flowing = welded ? welded->mesh : mesh;
    resolve_noise(command, flowing, welded ? welded->topology : topology, loop, run);
    command.options.time_step =
        time_step_of(command.amount, run.scale, command.options.steps, filter_of(command.options));
    stay_within_noise(command, flowing, loop, run);
}

}  // namespace

RunRecord begin_record(const SmoothCommand& command)
{
    return {.input = command.input.string(),
            .output = command.output.string(),
            .arguments = command.arguments,
            .laplacian = std::string(name_of(command.options.laplacian)),
            .flow = command.options.flow,
            .filter = filter_of(command.options),
            .rescale = command.options.motion.rescale,
            .keep_edges = command.options.keep_edges,
            .preset = command.preset};
}

void resolve_amount(SmoothCommand& command, const PolygonMesh& mesh, const Loop& loop, RunRecord& run)
{
    run.scale = measure_scale(mesh, loop);
    MotionOptions& motion = command.options.motion;
    motion.weld = command.weld ? std::optional(length_of(*command.weld, run.scale)) : std::nullopt;
    if (command.attach)
        motion.attachment = attachment_of(*command.attach, run.scale);
    if (command.amount.slope_of_noise)
        resolve_by_noise(command, mesh, loop, run);
    else
        command.options.time_step =
            time_step_of(command.amount, run.scale, command.options.steps, filter_of(command.options));
    if (motion.attachment > 0.0)
        run.attachment = motion.attachment;
    run.has_attachment_weights = !motion.attachment_weights.empty();
}

void remark_on_loss(const FlowOptions& options, const SurfaceChange& change, std::vector<std::string>& remarks,
                    bool can_rescale)
{
    constexpr double much = 0.2;
    constexpr double most = 0.5;  // of the area: noise alone may have much of it
    if (options.motion.rescale != Rescale::None)
        return;
    if (!change.before.volume || !change.after.volume) {
        if (change.after.area < most * change.before.area)
            remarks.push_back(fmt::format("The surface has lost {:.0f}% of its area: less smoothing is gentler.",
                                          100.0 * (1.0 - change.after.area / change.before.area)));
        return;
    }
    const double lost = 1.0 - *change.after.volume / *change.before.volume;
    if (lost > much)
        remarks.push_back(fmt::format("The surface has lost {:.0f}% of its volume: --filter low-pass loses less, {}and "
                                      "less smoothing is gentler.",
                                      100.0 * lost, can_rescale ? "--rescale volume scales it back, " : ""));
}

std::string missed_tolerance(const SmoothCommand& command, const ConvergenceReport& report)
{
    const int missed = steps_failed(command, report);
    if (missed == 0)
        return {};
    return fmt::format("the tolerance {} was missed in {} {}", *command.options.accuracy.tolerance, missed,
                       missed == 1 ? "step" : "steps");
}

}  // namespace seamflow
