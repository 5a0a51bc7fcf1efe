#include "engine/setup/presets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/measure/length_scale.h"
#include "engine/measure/smoothed_radius.h"
#include "engine/options/option_names.h"
#include "engine/options/option_rules.h"
#include "engine/options/option_traits.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/edge_measures.h"
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

/// The limit of motion along normals, as a multiple of the measured noise.
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

/// @returns the time step. @throws InputError if it is no normal number, as on a mesh without a size.
double require_step(double time_step)
{
    if (std::isnormal(time_step))
        return time_step;
    throw InputError(Wording{"the mesh has no size to measure noise by; use <time_step>"});
}

/// Chooses no steps, and any valid time step, because there must be one. Adds the remark why.
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
    LengthScale scale(mesh, exec);
    const std::optional<LengthOnMesh>& within = choice.options.motion.weld;
    const std::optional<Weld> welded = within ? weld(mesh, topology, scale.length_of(*within), exec) : std::nullopt;
    const PolygonMesh* const joined_mesh = welded ? &welded->mesh : &mesh;
    const std::vector<Spike> spikes = find_spikes(*joined_mesh, joined_mesh->vertices, exec);
    const std::optional<PolygonMesh> without =
        hold_spikes(*joined_mesh, welded ? welded->topology : topology, spikes, choice.options.motion);
    const PolygonMesh& flowing = without ? *without : *joined_mesh;
    const Topology& joined = welded ? welded->topology : topology;
    const double mean_edge = mean_edge_length(mesh, mesh.vertices, exec);
    choice.noise = known ? scale.length_of(*known) : measure_noise(flowing, joined, exec).deviation;
    if (*choice.noise == 0.0)
        return smooth_nothing(choice, mean_edge, "No noise can be told from the shape of the mesh");
    const double t = denoising_amount(flowing, joined, *choice.noise, exec).amount;
    const double most = largest_radius * largest_diagonal(mesh, exec);
    // t is without a unit, for L = D⁻¹ K (see denoising_amount). Δ_U is L times 4 / h², h being the mean edge length,
    // so that dt = t h² / 4.
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

/// A setting, and how it is made.
struct Setting {
    PresetSetting shown;
    void (*set)(const PresetTraits& preset, PresetSettings& settings);
};

Setting setting_of_direction()
{
    return {{"direction", "z"}, [](const PresetTraits&, PresetSettings& s) {
                s.options.motion.direction = {MotionDirection::Kind::Vector, Point::UnitZ()};
            }};
}

/// What removing noise needs.
std::vector<Setting> settings_of_denoise(const PresetTraits& preset)
{
    std::vector<Setting> list;
    if (preset.along_z)
        list.push_back(setting_of_direction());
    list.push_back({{"boundary", "free"},
                    [](const PresetTraits&, PresetSettings& s) { s.options.motion.boundary = Boundary::Free; }});
    return list;
}

/// The settings of a preset that takes steps of a flow: those that differ from the defaults, and the Laplacian.
std::vector<Setting> settings_of_flow(const PresetTraits& preset)
{
    const PresetTraits defaults{};
    std::vector<Setting> list;
    if (preset.along_z)
        list.push_back(setting_of_direction());
    // Steps that keep edges do not use the Laplacian.
    if (!preset.keep_edges)
        list.push_back({{"laplacian", std::string(name_of(preset.laplacian))},
                        [](const PresetTraits& p, PresetSettings& s) { s.options.laplacian = p.laplacian; }});
    if (preset.flow != defaults.flow)
        list.push_back({{"flow", std::string(option_name(preset.flow))},
                        [](const PresetTraits& p, PresetSettings& s) { s.options.flow = p.flow; }});
    if (preset.filter != defaults.filter)
        list.push_back({{"filter", std::string(option_name(preset.filter))},
                        [](const PresetTraits& p, PresetSettings& s) { s.options.filter = p.filter; }});
    if (preset.order != defaults.order)
        list.push_back({{"order", fmt::format("{}", preset.order)},
                        [](const PresetTraits& p, PresetSettings& s) { s.options.order = p.order; }});
    if (preset.keep_edges)
        list.push_back({{"keep_edges", fmt::format("{}", *preset.keep_edges)},
                        [](const PresetTraits& p, PresetSettings& s) { s.keep_edges = p.keep_edges; }});
    if (preset.attach)
        list.push_back(
            {{"attachment", fmt::format("{:g}%", 100.0 * preset.attach->value)},
             [](const PresetTraits& p, PresetSettings& s) { s.options.motion.attachment_radius = p.attach; }});
    if (preset.steps != defaults.steps)
        list.push_back({{"steps", fmt::format("{}", preset.steps)},
                        [](const PresetTraits& p, PresetSettings& s) { s.options.steps = p.steps; }});
    return list;
}

/// Whether options are about the equation of a flow.
bool wants_equation(const AskedOptions& asked)
{
    return !asked.first(concern::equations | concern::equation).empty();
}

/// Whether the caller has asked for a Laplacian with which an option of a preset does not go.
bool is_against(const FlowOptions& given, const AskedOptions& asked, std::string_view option)
{
    const bool is_further = option == "flow" || option == "filter" || option == "order" || option == "attachment";
    return is_further && asked.has("laplacian") && !is_symmetric(given.laplacian);
}

/// Whether an option of a preset was given, or does not go with the given options.
bool is_said(const FlowOptions& given, const AskedOptions& asked, std::string_view option)
{
    if (asked.has(option) || is_against(given, asked, option))
        return true;
    const Conditions conditions = given.interface.conditions;
    if (option == "direction")
        return asked.has("rescale") || asked.has("feature_edges") || is_classical(conditions) ||
               conditions == Conditions::Schwarz;
    if (option == "flow")
        return given.accuracy.approach == Approach::ConjugateGradients;
    if (option == "attachment")
        return asked.has("attachment_radius") || asked.has("attachment_weights");
    return option == "order" && asked.has("filter");
}

/// The options of denoise() that have the values of the same options of a flow.
DenoiseOptions denoise_options_of(const FlowOptions& options)
{
    return {.steps = options.steps,
            .motion = options.motion,
            .threads = options.resources.threads,
            .measures = options.report.measures};
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

const PresetTraits& default_preset(const AskedOptions& asked)
{
    if (asked.has("keep_edges") || asked.has("feature_edges"))
        return preset_of("cad");
    return wants_equation(asked) ? preset_of("scan") : table.front();
}

PresetSettings apply_preset(const PresetTraits& preset, FlowOptions given, const AskedOptions& asked,
                            bool is_noise_known)
{
    const bool is_amount_given = !asked.first(concern::amount).empty();
    const bool needs_equation = is_amount_given || (!preset.keep_edges && (wants_equation(asked) || is_noise_known));
    PresetSettings settings{.options = given, .chooses_amount = !is_amount_given};
    settings.denoise = preset.denoise && !needs_equation;
    if (preset.radius)
        settings.amount = {"radius", fmt::format("{:g}%", 100.0 * preset.radius->value)};
    for (const Setting& setting : settings.denoise ? settings_of_denoise(preset) : settings_of_flow(preset)) {
        const std::string_view option = setting.shown.option;
        if (!is_said(given, asked, option)) {
            setting.set(preset, settings);
            settings.chosen.push_back(setting.shown);
        } else if (!asked.has(option) && !is_symmetric(given.laplacian)) {
            settings.left_out.push_back(setting.shown);
        }
    }
    return settings;
}

void choose_amount(const PresetTraits& preset, const PolygonMesh& mesh, const std::optional<LengthOnMesh>& noise,
                   PresetChoice& choice, const Executor& exec)
{
    FlowOptions& options = choice.options;
    options.motion.limits = {.volume = ComponentLimits::most_volume_change};
    if (preset.radius) {
        LengthScale scale(mesh, exec);
        options.time_step = time_step_of({.radius = preset.radius}, options.steps, scale, filter_of(options));
    } else {
        choose_by_noise(mesh, noise, choice, exec);
    }
}

PresetChoice options_for(Preset preset, const PolygonMesh& mesh, const FlowOptions& further,
                         const std::optional<LengthOnMesh>& noise, const Executor& exec)
{
    require_valid(mesh, exec);
    const PresetTraits& traits = *std::ranges::find(table, preset, &PresetTraits::preset);
    PresetSettings settings = apply_preset(traits, further, changed_options(further), noise.has_value());
    PresetChoice choice{.options = std::move(settings.options)};
    const FlowOptions& options = choice.options;
    if (settings.denoise) {
        choice.denoise = denoise_options_of(options);
        choice.denoise->motion.limits = DenoiseOptions::default_motion().limits;
    } else if (settings.keep_edges) {
        choice.denoise = denoise_options_of(options);
        choice.denoise->method = SmoothBetweenEdges{
            .edge_angle = *settings.keep_edges,
            .amount = {options.time_step, options.time_step_edges, options.radius},
        };
    } else if (settings.chooses_amount) {
        choose_amount(traits, mesh, noise, choice, exec);
    }
    return choice;
}

}  // namespace seamflow
