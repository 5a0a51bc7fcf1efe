#include "samples/common/smoothing_request.h"

#include <cmath>
#include <string>

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
