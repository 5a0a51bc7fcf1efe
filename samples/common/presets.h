#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/options/flow_options.h"
#include "samples/common/smoothing_request.h"

namespace seamflow {

/// Options of `smooth` that together suit one kind of mesh.
struct Preset {
    std::string_view name;
    /// For --help.
    std::string_view purpose;
    Laplacian laplacian = Laplacian::VirtualRefinement;
    FlowEquation flow = FlowEquation::MeanCurvature;
    Filter filter = Filter::Diffusion;
    /// In degrees, if edges are kept.
    std::optional<double> keep_edges = {};
    /// What stays (see attachment_of), if vertices are attached.
    std::optional<LengthOnMesh> attach = {};
    int steps = 1;
    SmoothingRequest amount = {};
};

/// All of them, the one for meshes of which nothing is said first.
std::span<const Preset> presets();

/// One of the options that say the same as a preset, beside its amount.
struct PresetOption {
    /// "--steps", "3".
    std::string_view name;
    std::string value;
    /// Does what the option does.
    std::function<void(FlowOptions& options, std::optional<LengthOnMesh>& attach)> set;
};

std::vector<PresetOption> options_of(const Preset& preset);

/// The amount as an option, "--radius 3%"; empty where it follows from the noise of a mesh.
std::string amount_of(const Preset& preset);

}  // namespace seamflow
