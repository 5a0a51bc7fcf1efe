#include "samples/common/smoothing_request.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "engine/measure/surface_measures.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "samples/common/command_line.h"

namespace seamflow {

namespace {

double require_step(double time_step, const char* option)
{
    if (std::isnormal(time_step))
        return time_step;
    throw InputError(std::string("has no size to measure ") + option + " by; use --time-step");
}

}  // namespace

double time_step_edges_for_noise(double noise, double slope, bool is_low_pass, int steps)
{
    const double left = std::tan(slope * std::numbers::pi / 180.0);
    const double time = (is_low_pass ? 2.0 : 1.0) * noise / (4.0 * std::sqrt(std::numbers::pi) * left);
    // What is printed of it is to be all of it.
    return std::stod(fmt::format("{:.3g}", std::clamp(time, 0.01, 100.0) / steps));
}

LengthOnMesh parse_length(std::string_view text)
{
    const bool of_diagonal = text.ends_with('%');
    try {
        if (!of_diagonal)
            return {parse_real(text, positive()), false};
        return {parse_real(text.substr(0, text.size() - 1), positive()) / 100.0, true};
    } catch (const OptionError&) {
        throw OptionError("\"" + std::string(text) +
                          "\" is neither a positive length (0.5) nor a part of the bounding box's diagonal (2%)");
    }
}

double length_of(const LengthOnMesh& length, const MeshScale& scale)
{
    return length.value * (length.of_diagonal ? scale.diagonal : 1.0);
}

double attachment_of(const LengthOnMesh& length, const MeshScale& scale)
{
    if (length.of_diagonal && !std::isnormal(scale.diagonal))
        throw InputError("has no size to measure --attach by; use a length");
    const double radius = length_of(length, scale);
    const double weight = 1.0 / (radius * radius);
    if (!std::isnormal(weight))
        throw OptionError("--attach is too small or too large: 1/R² is beyond what a double can hold");
    return weight;
}

MeshScale measure_scale(const PolygonMesh& mesh, const Loop& loop)
{
    return {.mean_edge = mean_edge_length(mesh, mesh.vertices, loop), .diagonal = extent_of(mesh.vertices)};
}

double time_step_of(const SmoothingRequest& request, const MeshScale& scale, int steps, const StepFilter& filter)
{
    if (request.time_step_edges)
        return require_step(*request.time_step_edges * scale.mean_edge * scale.mean_edge, "--time-step-edges");
    if (!request.radius)
        return request.time_step;
    return time_step_for_radius(*request.radius, steps, scale.diagonal, filter);
}

}  // namespace seamflow
