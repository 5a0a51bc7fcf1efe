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
#include "partition/io/input_position.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/spikes.h"

namespace seamflow {

namespace {

/// The amount that the preset chooses.
void choose_amount(SmoothRequest& request, const PolygonMesh& mesh, const Executor& exec, RunRecord& run)
{
    const PresetTraits& preset = preset_of(request.preset);
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
        request.chosen = "nothing is smoothed";
    else if (preset.radius)
        request.chosen += request.chosen_amount;
    else
        request.chosen += fmt::format("--time-step-edges {:.3g}",
                                      request.options.time_step / (run.scale.mean_edge * run.scale.mean_edge));
}

}  // namespace

RunRecord begin_record(const SmoothRequest& request)
{
    return {.arguments = request.arguments,
            .preset = request.preset,
            .remarks = {request.remarks.begin(), request.remarks.end()}};
}

double seam_distance_of(const MotionOptions& motion)
{
    return motion.weld ? motion.weld->value : 0.0;
}

namespace {

/// On vertices without faces far from all faces.
/// @param vertices at least one, ascending.
std::string remark_on_far_vertices(const std::vector<Index>& vertices)
{
    const bool is_one = vertices.size() == 1;
    return fmt::format(
        "{} no face and lie{} further from the surface than it is large: {}; remove {} where other programs mind.",
        is_one ? fmt::format("Vertex {} (numbered from 0) has", vertices.front())
               : fmt::format("{} vertices, the first of which is {} (numbered from 0), have", vertices.size(),
                             vertices.front()),
        is_one ? "s" : "",
        is_one ? "it stays there, and counts in no length" : "they stay there, and count in no length",
        is_one ? "it" : "them");
}

}  // namespace

void remark_on_vertices(const PolygonMesh& mesh, const MeshScale& scale, const Executor& exec,
                        std::vector<Remark>& remarks)
{
    if (const std::vector<Index> far = far_from_faces(mesh, scale.unused_vertices, exec); !far.empty())
        remarks.push_back(remark_on_far_vertices(far));
}

void resolve_amount(SmoothRequest& request, const PolygonMesh& mesh, const Executor& exec, RunRecord& run)
{
    run.scale = measure_scale(mesh, exec);
    remark_on_vertices(mesh, run.scale, exec, run.remarks);
    if (request.chooses_amount)
        choose_amount(request, mesh, exec, run);
    // What removes noise names them itself.
    if (!request.options.denoise && !run.scale.spikes.empty())
        run.remarks.push_back(remark_on_spikes(run.scale.spikes));
    LengthScale scale = run.scale.lengths();
    FlowOptions& options = request.options;
    options = resolved(std::move(options), mesh, scale, exec, run.remarks);
}

namespace {

void remark_on_lost_cells(const std::vector<double>& before, const std::vector<double>& after,
                          std::vector<Remark>& remarks)
{
    constexpr double much = 0.2;
    std::size_t n_small = 0;
    for (std::size_t c = 0; c < before.size(); ++c)
        n_small += after[c] < (1.0 - much) * before[c] ? 1 : 0;
    if (n_small > 0)
        remarks.push_back(
            fmt::format("{} {} lost more than {:.0f}% of {} volume: less smoothing is gentler.",
                        before.size() == 1 ? "The only cell" : fmt::format("{} of {} cells", n_small, before.size()),
                        n_small == 1 ? "has" : "have", 100.0 * much, n_small == 1 ? "its" : "their"));
}

/// The loss of a body or of the whole surface that is worth a remark, as a fraction of its volume, or of its area where
/// it has no volume; 0 if it is small.
/// @param before, after with `volume` and `area`: BodySize or SurfaceLook.
template <class Size>
double large_loss(const Size& before, const Size& after)
{
    constexpr double much = 0.2;
    constexpr double most = 0.5;  // of the area: noise alone may have much of it
    const bool has_volume = before.volume && after.volume;
    const double lost = has_volume ? 1.0 - *after.volume / *before.volume : 1.0 - after.area / before.area;
    return lost > (has_volume ? much : most) ? lost : 0.0;
}

/// What helps, after a colon.
std::string remedies_of_loss(const AllOptions& options, const SurfaceChange& change)
{
    std::string remedies = "less smoothing is gentler";
    if (!change.before.volume)
        return remedies;
    const MotionOptions& motion = options.motion;
    const bool has_equation = !options.takes_whole_mesh() && options.scheme == Scheme::BackwardEuler;
    if (options.filter != Filter::LowPass && has_equation)
        remedies += ", --filter low-pass loses less";
    const bool moves_all =
        motion.fixed_vertices.empty() && motion.strength.empty() && motion.direction.kind == MotionDirection::Kind::Any;
    // A body that has become a point has no shape to scale back.
    const bool has_shapes =
        change.after.area > 0.0 &&
        std::ranges::none_of(change.after.bodies, [](const BodySize& body) { return body.area == 0.0; });
    if (change.before.cell_volumes.empty() && moves_all && has_shapes)
        remedies += change.before.bodies.empty() ? ", --rescale volume scales it back"
                                                 : ", --rescale volume scales each component back";
    return remedies;
}

}  // namespace

void remark_on_loss(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks)
{
    if (options.motion.rescale != Rescale::None)
        return;
    if (!change.before.cell_volumes.empty())
        remark_on_lost_cells(change.before.cell_volumes, change.after.cell_volumes, remarks);
    const std::string remedies = remedies_of_loss(options, change);
    const std::vector<BodySize>& before = change.before.bodies;
    std::size_t n_bodies = 0;
    double most = 0.0;
    for (std::size_t c = 0; c < before.size(); ++c)
        if (const double lost = large_loss(before[c], change.after.bodies[c]); lost > 0.0) {
            ++n_bodies;
            most = std::max(most, lost);
        }
    if (n_bodies > 0 && n_bodies < before.size()) {
        remarks.push_back(fmt::format("{} of {} components {} lost much, up to {:.0f}% of {} volume, or of the area of "
                                      "an open one: {}.",
                                      n_bodies, before.size(), n_bodies == 1 ? "has" : "have", 100.0 * most,
                                      n_bodies == 1 ? "its" : "their", remedies));
        return;
    }
    if (const double lost = large_loss(change.before, change.after); lost > 0.0)
        remarks.push_back(fmt::format("The surface has lost {:.0f}% of its {}: {}.", 100.0 * lost,
                                      change.before.volume && change.after.volume ? "volume" : "area", remedies));
}

void remark_on_folds(const AllOptions& options, const SurfaceChange& change, std::vector<Remark>& remarks)
{
    if (change.overlaps > 0)
        remarks.push_back(
            fmt::format("Sheets lie on each other with different faces, at {}: the volumes of cells are not "
                        "known. They would be if such sheets had the same faces.",
                        counted(change.overlaps, "edge", "edges")));
    if (change.surfaces > 1 && !change.before.cell_volumes.empty())
        remarks.push_back(fmt::format("{} surfaces with cells do not touch: where one lies in a cell of another, it "
                                      "counts in the volume of that cell.",
                                      change.surfaces));
    std::string what;
    if (const std::size_t n = change.folded_faces.value_or(0); n > 0)
        what = fmt::format("{} turned over against neighbouring faces",
                           n == 1 ? "1 face has" : fmt::format("{} faces have", n));
    if (const std::size_t n = change.new_self_intersections.value_or(0); n > 0)
        what += fmt::format("{}{} of faces cross{} now that did not before", what.empty() ? "" : ", and ",
                            n == 1 ? "1 pair" : fmt::format("{} pairs", n), n == 1 ? "es" : "");
    if (!what.empty())
        remarks.emplace_back(
            what + ": smooth less, or pass " +
            (options.motion.within ? "a smaller --within." : "--within with a length below that of the edges there."));
}

std::string missed_tolerance(const SmoothRequest& request, const ConvergenceReport& report)
{
    const std::optional<double>& tolerance = request.options.accuracy.tolerance;
    const int missed = request.limits_iterations ? report.steps_stagnated : report.steps_short_of_tolerance;
    return !tolerance || missed == 0 ? ""
                                     : fmt::format("the tolerance {} was missed in {}", *tolerance,
                                                   counted(static_cast<std::uint64_t>(missed), "step", "steps"));
}

}  // namespace seamflow
