#include "samples/report/smoothing_request.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/edge_measures.h"
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
    const std::vector<std::uint8_t> is_used = used_by_faces(mesh, exec);
    EdgeMeasures edges = measure_edges(mesh, mesh.vertices, exec);
    return {.mean_edge = edges.mean,
            .diagonal = box_of_vertices(mesh.vertices, is_used, exec).diagonal(),
            .unused_vertices = select(exec, mesh.n_vertices(), [&](Index v) { return is_used[v] == 0; }),
            .spikes = std::move(edges.spikes)};
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
