#include "samples/common/presets.h"

#include <array>

#include <fmt/format.h>

#include "engine/options/option_names.h"

namespace seamflow {

namespace {

/// Noise leaves slopes of half a degree.
constexpr double half_a_degree = 0.5;

constexpr std::array table{
    Preset{.name = "scan",
           .purpose = "removes the noise that the mesh is found to have, and hardly shrinks what is large",
           .filter = Filter::LowPass,
           .steps = 3,
           .amount = {.slope_of_noise = half_a_degree}},
    Preset{.name = "cad",
           .purpose = "removes noise between edges of more than 30 degrees, and keeps these",
           .keep_edges = 30.0,
           .amount = {.time_step_edges = 32.0}},
    Preset{.name = "terrain",
           .purpose = "removes noise, and keeps landforms larger than 5 % of the diagonal where they are",
           .attach = LengthOnMesh{0.05, true},
           .steps = 3,
           .amount = {.slope_of_noise = half_a_degree}},
    Preset{.name = "fair",
           .purpose = "makes a calm surface: bumps of up to 3 % of the diagonal lose half their height or more",
           .flow = FlowEquation::Conformalized,
           .steps = 5,
           .amount = {.radius = LengthOnMesh{0.03, true}}},
};

}  // namespace

std::span<const Preset> presets()
{
    return table;
}

std::vector<PresetOption> options_of(const Preset& preset)
{
    using Attach = std::optional<LengthOnMesh>;
    const Preset defaults;
    std::vector<PresetOption> options;
    // What keeps edges does not look at the Laplacian.
    if (!preset.keep_edges)
        options.push_back({"--laplacian", std::string(name_of(preset.laplacian)),
                           [=](FlowOptions& o, Attach&) { o.laplacian = preset.laplacian; }});
    if (preset.flow != defaults.flow)
        options.push_back(
            {"--flow", std::string(option_name(preset.flow)), [=](FlowOptions& o, Attach&) { o.flow = preset.flow; }});
    if (preset.filter != defaults.filter)
        options.push_back({"--filter", std::string(option_name(preset.filter)),
                           [=](FlowOptions& o, Attach&) { o.filter = preset.filter; }});
    if (preset.keep_edges)
        options.push_back({"--keep-edges", fmt::format("{}", *preset.keep_edges),
                           [=](FlowOptions& o, Attach&) { o.keep_edges = preset.keep_edges; }});
    if (preset.attach)
        options.push_back({"--attach", fmt::format("{:g}%", 100.0 * preset.attach->value),
                           [=](FlowOptions&, Attach& attach) { attach = preset.attach; }});
    if (preset.steps != defaults.steps)
        options.push_back(
            {"--steps", fmt::format("{}", preset.steps), [=](FlowOptions& o, Attach&) { o.steps = preset.steps; }});
    return options;
}

std::string amount_of(const Preset& preset)
{
    if (preset.amount.time_step_edges)
        return fmt::format("--time-step-edges {}", *preset.amount.time_step_edges);
    return preset.amount.radius ? fmt::format("--radius {:g}%", 100.0 * preset.amount.radius->value) : "";
}

}  // namespace seamflow
