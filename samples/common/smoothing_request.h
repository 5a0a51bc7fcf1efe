#pragma once

#include <optional>
#include <string_view>

#include "engine/setup/smoothed_radius.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Reads a positive length: "0.5" in units of length, "2%" of the diagonal.
/// @throws OptionError saying what was expected.
LengthOnMesh parse_length(std::string_view text);

/// The sizes of a mesh that amounts of smoothing are measured by, in units of length.
struct MeshScale {
    double mean_edge = 0.0;
    /// Of the bounding box of all vertices.
    double diagonal = 0.0;
};

MeshScale measure_scale(const PolygonMesh& mesh, const Loop& loop = run_serially);

/// In units of length.
double length_of(const LengthOnMesh& length, const MeshScale& scale);

/// w = 1/R² of an attachment that leaves what is larger than R (see MotionOptions::attachment), in 1/length².
/// @throws InputError for a mesh that has no size to measure by; OptionError for a length whose w no double can hold.
double attachment_of(const LengthOnMesh& length, const MeshScale& scale);

/// How much a flow is to smooth, in one of four ways.
struct SmoothingRequest {
    /// dt in length².
    double time_step = 0.0;
    /// dt in squared mean edge lengths, if not empty.
    std::optional<double> time_step_edges = {};
    /// What all steps together smooth (see smoothed_radius), if not empty.
    std::optional<LengthOnMesh> radius = {};
    /// The slope, in degrees and as root mean square, that is to be left of the noise of the mesh (see estimate_noise),
    /// if not empty.
    std::optional<double> slope_of_noise = {};
};

/// The time step, in squared mean edge lengths and with three digits, with which that many steps leave such a slope of
/// noise. After a time t of diffusion the slope of white noise of deviation σ at points with an area of e² each is
/// σ e / (4 √π t). A low-pass filter takes twice as long.
/// @param noise in mean edge lengths. @param slope in degrees, above 0. @param steps at least 1.
/// @returns at least .01 and at most 100, over all steps.
double time_step_edges_for_noise(double noise, double slope, bool is_low_pass, int steps);

/// dt in length² for that many steps, each with that filter.
/// @throws InputError for a mesh that has no size to measure by.
double time_step_of(const SmoothingRequest& request, const MeshScale& scale, int steps, const StepFilter& filter = {});

}  // namespace seamflow
