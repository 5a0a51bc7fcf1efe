#include "engine/measure/length_scale.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/measure/smoothed_radius.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

LengthScale::LengthScale(const PolygonMesh& mesh, Executor exec)
    : mesh_(&mesh)
    , exec_(std::move(exec))
{
}

LengthScale::LengthScale(double mean_edge, double diagonal)
    : mean_edge_(mean_edge)
    , diagonal_(diagonal)
{
}

/// The mesh, after a check.
/// @throws InputError if it is not valid.
const PolygonMesh& LengthScale::mesh() const
{
    require_valid(*mesh_, exec_);
    return *mesh_;
}

double LengthScale::mean_edge()
{
    if (!mean_edge_)
        mean_edge_ = mean_edge_length(mesh(), mesh_->vertices, exec_);
    return *mean_edge_;
}

double LengthScale::diagonal()
{
    if (!diagonal_)
        diagonal_ = box_of_faces(mesh(), exec_).diagonal();
    return *diagonal_;
}

double LengthScale::length_of(const LengthOnMesh& length)
{
    return length.value * (length.of_diagonal ? diagonal() : 1.0);
}

double time_step_of(const SmoothingAmount& amount, int steps, LengthScale& scale, const StepFilter& filter)
{
    if (amount.time_step_edges) {
        const double time_step = *amount.time_step_edges * scale.mean_edge() * scale.mean_edge();
        if (!std::isnormal(time_step))
            throw InputError(Wording{"the mesh has no size to measure <time_step_edges> by; use <time_step>"});
        return time_step;
    }
    if (!amount.radius)
        return amount.time_step;
    const double radius = scale.length_of(*amount.radius);
    const double time_step = time_step_for_radius(radius, std::max(steps, 1), filter);
    if (std::isinf(time_step))
        throw OptionError("the radius is too large: the time step that it takes is beyond what a double can hold");
    if (!std::isnormal(time_step))
        throw InputError("the mesh has no size to measure a radius by; use a time step");
    return time_step;
}

}  // namespace seamflow
