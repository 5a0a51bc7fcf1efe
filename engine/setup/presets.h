#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/denoise/denoise_options.h"
#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

struct AskedOptions;

/// Options that together suit one kind of mesh.
enum class Preset {
    Automatic,
    Scan,
    Cad,
    Terrain,
    Fair,
};

/// The settings of a preset. An amount given here is applied in FlowOptions::steps steps; otherwise it follows from the
/// noise of the mesh, or none is needed.
struct PresetTraits {
    Preset preset;
    /// In lower case.
    std::string_view name;
    /// For users: what it does.
    std::string_view purpose;
    Laplacian laplacian = Laplacian::Uniform;
    FlowEquation flow = FlowEquation::MeanCurvature;
    Filter filter = Filter::Diffusion;
    int order = 1;
    /// In degrees, if edges are kept.
    std::optional<double> keep_edges = {};
    /// Whether noise is removed (see denoise) where no amount is given. With an amount the preset has its equation.
    bool denoise = false;
    /// Whether vertices move along z alone.
    bool along_z = false;
    /// MotionOptions::attachment_radius, if vertices are attached.
    std::optional<LengthOnMesh> attach = {};
    int steps = 1;
    /// The radius that all steps smooth.
    std::optional<LengthOnMesh> radius = {};

    /// Whether the amount for its equation follows from the noise.
    [[nodiscard]] bool measures_noise() const { return !keep_edges && !radius; }
};

/// All presets; first the preset for meshes of unspecified kind.
std::span<const PresetTraits> all_presets();

/// @throws OptionError for an unknown name.
const PresetTraits& preset_of(std::string_view name);

/// The preset for a caller who names none and gives no amount.
const PresetTraits& default_preset(const AskedOptions& asked);

/// An option that a preset sets: its name in the table of options, and its value in words.
struct PresetSetting {
    std::string_view option;
    std::string value;
};

/// The options of a caller, completed by the options of a preset, except its amount, where the caller has not asked for
/// an option.
struct PresetSettings {
    FlowOptions options;
    /// Whether noise is removed (see denoise) in place of a flow.
    bool denoise = false;
    /// In degrees, if the preset keeps edges.
    std::optional<double> keep_edges = {};
    /// Whether the preset chooses how much is smoothed.
    bool chooses_amount = true;
    /// The settings of the preset that were made.
    std::vector<PresetSetting> chosen = {};
    /// The amount, if it does not follow from the noise.
    std::optional<PresetSetting> amount = {};
    /// The settings of the preset that are left out, because the Laplacian that was asked for does not support them.
    std::vector<PresetSetting> left_out = {};
};

/// @param given options of the caller. @param asked which of them the caller has asked for.
/// @param is_noise_known whether the caller knows how large the noise is.
PresetSettings apply_preset(const PresetTraits& preset, FlowOptions given, const AskedOptions& asked,
                            bool is_noise_known = false);

/// Options, and why they are so.
struct PresetChoice {
    /// With an amount, and limits for each component of the mesh.
    FlowOptions options;
    /// If the preset removes noise or keeps edges: the options of denoise(), which is then to be called in place of a
    /// flow.
    std::optional<DenoiseOptions> denoise = {};
    /// The standard deviation of the noise, measured or given, in length; empty unless the amount follows from it.
    std::optional<double> noise = {};
    /// Where nothing is smoothed: why.
    std::optional<Remark> remark = {};
};

/// The options of a preset for a mesh, to be changed at will and given to mean_curvature_flow or denoise. A preset that
/// denoises does so where no noise is given, and no option that needs the equation of a flow.
/// @param further options of the caller; where they differ from their defaults, they replace the options of the preset.
/// @param noise the standard deviation of the noise along the normals, where it is known; Preset::Cad and Preset::Fair
/// ignore it.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by.
PresetChoice options_for(Preset preset, const PolygonMesh& mesh, const FlowOptions& further = {},
                         const std::optional<LengthOnMesh>& noise = {}, const Executor& exec = run_serially);

/// Chooses the amount of a preset and its limits, also for options other than its own: an amount by the noise halves
/// the height of those bumps whose height the preset's own options would halve.
/// @param choice has all options except the amount; receives that, the noise and the remark.
void choose_amount(const PresetTraits& preset, const PolygonMesh& mesh, const std::optional<LengthOnMesh>& noise,
                   PresetChoice& choice, const Executor& exec = run_serially);

}  // namespace seamflow
