#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/options/flow_options.h"
#include "partition/executor.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Options that together suit one kind of mesh.
enum class Preset {
    Scan,
    Cad,
    Terrain,
    Fair,
};

/// What a preset says. An amount that is given here takes part in FlowOptions::steps steps; where none is, it follows
/// from the noise of the mesh.
struct PresetTraits {
    Preset preset;
    /// Small letters.
    std::string_view name;
    /// For users: what it does.
    std::string_view purpose;
    Laplacian laplacian = Laplacian::Uniform;
    FlowEquation flow = FlowEquation::MeanCurvature;
    Filter filter = Filter::Diffusion;
    int order = 1;
    /// In degrees, if edges are kept.
    std::optional<double> keep_edges = {};
    /// What stays (see attachment_of), if vertices are attached.
    std::optional<LengthOnMesh> attach = {};
    int steps = 1;
    /// dt in squared mean edge lengths, less where its root is above a fifth of the diagonal; or what all steps
    /// together smooth.
    std::optional<double> time_step_edges = {};
    std::optional<LengthOnMesh> radius = {};

    [[nodiscard]] bool measures_noise() const { return !time_step_edges && !radius; }
};

/// All of them, the one for meshes of which nothing is said first.
std::span<const PresetTraits> all_presets();

/// @throws OptionError for a name that none of them has.
const PresetTraits& preset_of(std::string_view name);

/// Options, and why they are so.
struct PresetChoice {
    /// With an amount, and limits for each component of the mesh.
    FlowOptions options;
    /// What was measured of the mesh, or given, in length, where the amount follows from it.
    std::optional<double> noise = {};
    /// A sentence where nothing is smoothed; else empty.
    std::string remark = {};
};

/// The options of a preset for a mesh, to be changed at will and given to mean_curvature_flow.
/// @param further what has nothing to do with the preset: fixed vertices, threads, reports, and so on.
/// @param noise the standard deviation of the noise along the normals, where it is known.
/// @throws InputError for a mesh that is not valid, or that has no size to measure by ("has no size …").
PresetChoice options_for(Preset preset, const PolygonMesh& mesh, const FlowOptions& further = {},
                         const std::optional<LengthOnMesh>& noise = {}, const Executor& exec = run_serially);

/// The amount of a preset, and its limits, for other options than its own, too: an amount by the noise is that with
/// which bumps are half as high that the preset's own options would make half as high.
/// @param choice its options all but the amount; receives that, the noise and the remark.
void choose_amount(const PresetTraits& preset, const PolygonMesh& mesh, const std::optional<LengthOnMesh>& noise,
                   PresetChoice& choice, const Executor& exec = run_serially);

/// In units of length.
/// @param diagonal of the bounding box of all vertices.
double length_of(const LengthOnMesh& length, double diagonal);

/// w = 1/R² of an attachment that leaves what is larger than R (see MotionOptions::attachment), in 1/length².
/// @param diagonal of the bounding box of all vertices, in length.
/// @throws InputError for a mesh that has no size to measure by; OptionError for a length whose w no double can hold.
double attachment_of(const LengthOnMesh& length, double diagonal);

}  // namespace seamflow
