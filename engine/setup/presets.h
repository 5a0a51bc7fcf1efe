#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "engine/denoise/denoise_options.h"
#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"
#include "partition/remark.h"

namespace seamflow {

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
    /// Length for attachment_of, if vertices are attached.
    std::optional<LengthOnMesh> attach = {};
    int steps = 1;
    /// The radius that all steps smooth.
    std::optional<LengthOnMesh> radius = {};

    /// Whether the amount for its equation follows from the noise.
    [[nodiscard]] bool measures_noise() const { return !keep_edges && !radius; }
};

inline MotionDirection along_z()
{
    return {MotionDirection::Kind::Vector, Point::UnitZ()};
}

/// All of them, first the one for meshes of unspecified kind.
std::span<const PresetTraits> all_presets();

/// @throws OptionError for an unknown name.
const PresetTraits& preset_of(std::string_view name);

/// Options, and why they are so.
struct PresetChoice {
    /// With an amount, and limits for each component of the mesh.
    FlowOptions options;
    /// In place of them, if the preset removes noise: those of denoise().
    std::optional<DenoiseOptions> denoise = {};
    /// As measured from the mesh, or given, in length, if the amount follows from it.
    std::optional<double> noise = {};
    /// Where nothing is smoothed: why.
    std::optional<Remark> remark = {};
};

/// The options of a preset for a mesh, to be changed at will and given to mean_curvature_flow or denoise. A preset that
/// denoises does so where no noise is given that its equation could take its amount from.
/// @param further options unrelated to the preset: fixed vertices, threads, reports, and so on.
/// @param noise the standard deviation of the noise along the normals, where it is known; Preset::Cad and Preset::Fair
/// ignore it.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by ("has no size …").
PresetChoice options_for(Preset preset, const PolygonMesh& mesh, const FlowOptions& further = {},
                         const std::optional<LengthOnMesh>& noise = {}, const Executor& exec = run_serially);

/// Chooses the amount of a preset and its limits, also for options other than its own: an amount by the noise halves
/// the height of those bumps whose height the preset's own options would halve.
/// @param choice has all options except the amount; receives that, the noise and the remark.
void choose_amount(const PresetTraits& preset, const PolygonMesh& mesh, const std::optional<LengthOnMesh>& noise,
                   PresetChoice& choice, const Executor& exec = run_serially);

/// In units of length.
/// @param diagonal of the bounding box of all vertices.
double length_of(const LengthOnMesh& length, double diagonal);

/// w = 1/R² of an attachment that keeps what is larger than R (see MotionOptions::attachment), in 1/length².
/// @param diagonal of the bounding box of all vertices, in length.
/// @throws InputError for a mesh that has no size to measure by; OptionError for a length whose w no double can hold.
double attachment_of(const LengthOnMesh& length, double diagonal);

}  // namespace seamflow
