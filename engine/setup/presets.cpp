#include "engine/setup/presets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/measure/smoothed_radius.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/spikes.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/surface_components.h"
#include "partition/topology.h"
#include "partition/weld.h"
#include "solvers/denoising/denoising_amount.h"
#include "solvers/denoising/mesh_denoiser.h"

namespace seamflow {

namespace {

/// Order of the filter that noise is measured for (see denoising_amount).
constexpr int denoising_order = 3;

constexpr std::array table{
    PresetTraits{.preset = Preset::Automatic,
                 .name = "automatic",
                 .purpose = "finds out how large the noise is at each place, removes it, and keeps edges and details",
                 .order = denoising_order,
                 .denoise = true},
    PresetTraits{.preset = Preset::Scan,
                 .name = "scan",
                 .purpose = "removes the measured noise, and hardly changes larger features",
                 .order = denoising_order},
    PresetTraits{.preset = Preset::Cad,
                 .name = "cad",
                 .purpose = "as automatic; with an amount, keeps edges of more than 30 degrees",
                 .laplacian = Laplacian::VirtualRefinement,
                 .keep_edges = RemoveNoise::default_edge_angle,
                 .denoise = true},
    PresetTraits{.preset = Preset::Terrain,
                 .name = "terrain",
                 .purpose = "as automatic, and x and y stay; with an amount, keeps landforms larger than 5 % of the "
                            "diagonal",
                 .order = denoising_order,
                 .denoise = true,
                 .along_z = true,
                 .attach = LengthOnMesh{0.05, true}},
    PresetTraits{.preset = Preset::Fair,
                 .name = "fair",
                 .purpose =
                     "makes a fair surface: bumps of up to 3 % of the diagonal lose about half their height or more",
                 .laplacian = Laplacian::VirtualRefinement,
                 .flow = FlowEquation::Conformalized,
                 .steps = 5,
                 .radius = LengthOnMesh{0.03, true}},
};

/// Of noise, over what is measured.
constexpr double more_than_measured = 1.15;
/// How far vertices move along the surface at most, in standard deviations of the noise, which also moved them there.
constexpr double most_slide = 4.0;
/// Larger bumps, as a fraction of the diagonal of the largest component, are not noise: no larger ones are smoothed.
constexpr double largest_radius = 0.1;

/// Three digits, so that an amount is printed in full.
double rounded(double value)
{
    return std::stod(fmt::format("{:.3g}", value));
}

double require_step(double time_step)
{
    if (std::isnormal(time_step))
        return time_step;
    throw InputError(Wording{"has no size to measure noise by; use <time_step>"});
}

void smooth_nothing(PresetChoice& choice, double mean_edge, std::string_view why)
{
    choice.options.steps = 0;
    choice.options.time_step = std::isnormal(mean_edge * mean_edge) ? mean_edge * mean_edge : 1.0;
    choice.remark.emplace("nothing smoothed", Remark::Numbers{{"noise", *choice.noise}},
                          Wording{fmt::format("{}: nothing is smoothed. Use <radius> to smooth anyway.", why)});
}

/// Puts spikes among their neighbours, so that they count neither as noise nor as shape. The flow is to hold them, and
/// their neighbours, which they would drag along: unless all vertices have to move.
/// @returns nothing if there are none.
std::optional<PolygonMesh> hold_spikes(const PolygonMesh& mesh, const Topology& topology,
                                       const std::vector<Spike>& spikes, MotionOptions& motion)
{
    if (spikes.empty())
        return {};
    std::optional<PolygonMesh> without = mesh;
    without->vertices = without_spikes(mesh, topology, spikes, mesh.vertices);
    for (const Spike& spike : spikes) {
        if (motion.rescale != Rescale::None)
            continue;
        const std::vector<Index> around = neighbours_of(mesh, topology, spike.vertex);
        motion.fixed_vertices.push_back(spike.vertex);
        motion.fixed_vertices.insert(motion.fixed_vertices.end(), around.begin(), around.end());
    }
    return without;
}

/// Chooses by the noise of the mesh that flows.
void choose_by_noise(const PolygonMesh& mesh, const std::optional<LengthOnMesh>& known, PresetChoice& choice,
                     const Executor& exec)
{
    const Topology topology = make_topology(mesh, exec);
    const std::optional<double> within = choice.options.motion.weld;
    const std::optional<Weld> welded = within ? weld(mesh, topology, *within, exec) : std::nullopt;
    const PolygonMesh* const joined_mesh = welded ? &welded->mesh : &mesh;
    const std::vector<Spike> spikes = find_spikes(*joined_mesh, joined_mesh->vertices, exec);
    const std::optional<PolygonMesh> without =
        hold_spikes(*joined_mesh, welded ? welded->topology : topology, spikes, choice.options.motion);
    const PolygonMesh& flowing = without ? *without : *joined_mesh;
    const Topology& joined = welded ? welded->topology : topology;
    const double mean_edge = mean_edge_length(mesh, mesh.vertices, exec);
    const double diagonal = box_of_faces(mesh, exec).diagonal();
    choice.noise = known ? length_of(*known, diagonal) : measure_noise(flowing, joined, exec).deviation;
    if (*choice.noise == 0.0)
        return smooth_nothing(choice, mean_edge, "No noise can be told from the shape of the mesh");
    const double t = denoising_amount(flowing, joined, *choice.noise, exec).amount;
    // Of Δ_U, dt h²/4 of whose rows of the mean of differences are t.
    const double most = largest_radius * largest_diagonal(mesh, exec);
    const double radius =
        std::min(smoothed_radius(0.25 * t * mean_edge * mean_edge, 1, {.order = denoising_order}), most);
    if (!(radius > 0.0) || !(*choice.noise <= most))
        return smooth_nothing(
            choice, mean_edge,
            known ? fmt::format("With noise of {:.3g}, no amount is expected to bring the mesh nearer to the true "
                                "surface",
                                *choice.noise)
                  : "The noise of the mesh cannot be told from its shape well enough for smoothing to bring it nearer "
                    "to the true surface");
    const double edges = time_step_for_radius(radius, std::max(choice.options.steps, 1), filter_of(choice.options)) /
                         (mean_edge * mean_edge);
    choice.options.time_step = require_step(rounded(edges) * mean_edge * mean_edge);
    choice.options.motion.limits.move = (known ? 1.0 : more_than_measured) * *choice.noise;
    choice.options.motion.limits.slide = most_slide * choice.options.motion.limits.move;
}

}  // namespace

std::span<const PresetTraits> all_presets()
{
    return table;
}

const PresetTraits& preset_of(std::string_view name)
{
    const auto found = std::ranges::find(table, name, &PresetTraits::name);
    if (found == table.end())
        throw OptionError(fmt::format("there is no preset \"{}\"", name));
    return *found;
}

double length_of(const LengthOnMesh& length, double diagonal)
{
    return length.value * (length.of_diagonal ? diagonal : 1.0);
}

double attachment_of(const LengthOnMesh& length, double diagonal)
{
    if (length.of_diagonal && !std::isnormal(diagonal))
        throw InputError(Wording{"has no size to measure <attachment> by; use a length"});
    const double radius = length_of(length, diagonal);
    const double weight = 1.0 / (radius * radius);
    if (!std::isnormal(weight))
        throw OptionError(Wording{"<attachment> is too small or too large: 1/R² is beyond what a double can hold"});
    return weight;
}

void choose_amount(const PresetTraits& preset, const PolygonMesh& mesh, const std::optional<LengthOnMesh>& noise,
                   PresetChoice& choice, const Executor& exec)
{
    FlowOptions& options = choice.options;
    options.motion.limits = {.volume = ComponentLimits::most_volume_change};
    if (preset.radius) {
        options.time_step = time_step_for_radius(*preset.radius, options.steps, box_of_faces(mesh, exec).diagonal(),
                                                 filter_of(options));
    } else {
        choose_by_noise(mesh, noise, choice, exec);
    }
}

PresetChoice options_for(Preset preset, const PolygonMesh& mesh, const FlowOptions& further,
                         const std::optional<LengthOnMesh>& noise, const Executor& exec)
{
    require_valid(mesh, exec);
    const PresetTraits& traits = *std::ranges::find(table, preset, &PresetTraits::preset);
    PresetChoice choice{.options = further};
    FlowOptions& options = choice.options;
    options.laplacian = traits.laplacian;
    options.flow = traits.flow;
    options.filter = traits.filter;
    options.order = traits.order;
    if (traits.along_z)
        options.motion.direction = along_z();
    if (traits.denoise && !(noise && traits.measures_noise())) {
        DenoiseOptions& denoise = choice.denoise.emplace();
        denoise.motion = further.motion;
        denoise.motion.boundary = Boundary::Free;
        denoise.motion.limits = DenoiseOptions::default_motion().limits;
        denoise.motion.direction = options.motion.direction;
        denoise.threads = further.resources.threads;
        denoise.measures = further.report.measures;
        return choice;
    }
    options.steps = traits.steps;
    options.radius.reset();
    if (traits.attach)
        options.motion.attachment = attachment_of(*traits.attach, box_of_faces(mesh, exec).diagonal());
    choose_amount(traits, mesh, noise, choice, exec);
    return choice;
}

}  // namespace seamflow
