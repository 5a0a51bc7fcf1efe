#include "samples/report/smoothing_request.h"

#include <cmath>
#include <string>

#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

namespace {

double require_step(double time_step, const char* option)
{
    if (std::isnormal(time_step))
        return time_step;
    throw InputError(std::string("has no size to measure ") + option + " by; use --time-step");
}

}  // namespace

MeshScale measure_scale(const PolygonMesh& mesh, const Executor& exec)
{
    return {.mean_edge = mean_edge_length(mesh, mesh.vertices, exec), .diagonal = box_of_faces(mesh, exec).diagonal()};
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
