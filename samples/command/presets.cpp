#include "samples/command/presets.h"

#include <fmt/format.h>

#include "engine/options/option_names.h"

namespace seamflow {

std::vector<PresetOption> options_of(const PresetTraits& preset, bool denoise)
{
    using Attach = std::optional<LengthOnMesh>;
    const PresetTraits defaults{};
    std::vector<PresetOption> options;
    if (preset.along_z)
        options.push_back({"--direction", "z", [](AllOptions& o, Attach&) { o.motion.direction = along_z(); }});
    if (denoise) {
        options.push_back({"", "", [](AllOptions& o, Attach&) { o.denoise = true; }});
        options.push_back({"--boundary", "free", [](AllOptions& o, Attach&) { o.motion.boundary = Boundary::Free; }});
        return options;
    }
    // Steps that keep edges do not use the Laplacian.
    if (!preset.keep_edges)
        options.push_back({"--laplacian", std::string(name_of(preset.laplacian)),
                           [=](AllOptions& o, Attach&) { o.laplacian = preset.laplacian; }});
    if (preset.flow != defaults.flow)
        options.push_back(
            {"--flow", std::string(option_name(preset.flow)), [=](AllOptions& o, Attach&) { o.flow = preset.flow; }});
    if (preset.filter != defaults.filter)
        options.push_back({"--filter", std::string(option_name(preset.filter)),
                           [=](AllOptions& o, Attach&) { o.filter = preset.filter; }});
    if (preset.order != defaults.order)
        options.push_back(
            {"--order", fmt::format("{}", preset.order), [=](AllOptions& o, Attach&) { o.order = preset.order; }});
    if (preset.keep_edges)
        options.push_back({"--keep-edges", fmt::format("{}", *preset.keep_edges),
                           [=](AllOptions& o, Attach&) { o.keep_edges = preset.keep_edges; }});
    if (preset.attach)
        options.push_back({"--attach", fmt::format("{:g}%", 100.0 * preset.attach->value),
                           [=](AllOptions&, Attach& attach) { attach = preset.attach; }});
    if (preset.steps != defaults.steps)
        options.push_back(
            {"--steps", fmt::format("{}", preset.steps), [=](AllOptions& o, Attach&) { o.steps = preset.steps; }});
    return options;
}

std::string amount_of(const PresetTraits& preset)
{
    return preset.radius ? fmt::format("--radius {:g}%", 100.0 * preset.radius->value) : "";
}

}  // namespace seamflow
