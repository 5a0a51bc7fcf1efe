#include "samples/runs/smoothing_run.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "engine/setup/presets.h"
#include "engine/setup/resolved_options.h"
#include "partition/errors.h"
#include "partition/io/input_file.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/edge_measures.h"

namespace seamflow {

namespace {

/// The amount that the preset chooses.
void choose_amount(SmoothRequest& request, const PolygonMesh& mesh, const Executor& exec, RunRecord& run)
{
    const PresetTraits& preset = *request.preset;
    if (request.options.denoise) {
        request.options.motion.limits = DenoiseOptions::default_motion().limits;
        return;
    }
    PresetChoice choice{.options = request.options};
    choose_amount(preset, mesh, request.noise, choice, exec);
    static_cast<FlowOptions&>(request.options) = std::move(choice.options);
    if (choice.remark)
        run.remarks.push_back(*choice.remark);
    if (choice.noise)
        run.noise = run.scale.mean_edge > 0.0 ? *choice.noise / run.scale.mean_edge : 0.0;
    if (choice.remark)
        run.chosen = "nothing is smoothed";
    else if (preset.radius)
        run.chosen += request.chosen_amount;
    else
        run.chosen += fmt::format("--time-step-edges {:.3g}",
                                  request.options.time_step / (run.scale.mean_edge * run.scale.mean_edge));
}

}  // namespace

RunRecord begin_record(const SmoothRequest& request)
{
    return {.arguments = request.arguments,
            .preset = std::string(request.preset != nullptr ? request.preset->name : ""),
            .chosen = request.chosen,
            .remarks = {request.remarks.begin(), request.remarks.end()}};
}

void resolve_amount(SmoothRequest& request, const PolygonMesh& mesh, const Executor& exec, RunRecord& run)
{
    if (!run.scale.far_vertices.empty())
        run.remarks.push_back(remark_on_far_vertices(run.scale.far_vertices));
    if (request.chooses_amount)
        choose_amount(request, mesh, exec, run);
    // What removes noise names them itself.
    if (!request.options.denoise && !run.scale.spikes.empty())
        run.remarks.push_back(remark_on_spikes(run.scale.spikes));
    LengthScale scale = run.scale.lengths();
    FlowOptions& options = request.options;
    options = resolved(std::move(options), mesh, scale, exec, run.remarks);
    run.names = flow_names(request.options, options.steps);
}

}  // namespace seamflow
