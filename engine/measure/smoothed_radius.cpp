#include "engine/measure/smoothed_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/metrics/bounding_box.h"

namespace seamflow {

namespace {

/// dt / R² with which half of a bump is left after all steps.
double step_per_squared_radius(int steps, const StepFilter& filter)
{
    const double lambda = filter.is_plain() ? std::expm1(std::numbers::ln2 / steps)
                                            : lambda_of(filter, std::exp2(-1.0 / static_cast<double>(steps)));
    return 2.0 * lambda / (std::numbers::pi * std::numbers::pi);
}

}  // namespace

double smoothed_radius(double time_step, int steps, const StepFilter& filter)
{
    return std::sqrt(time_step / step_per_squared_radius(steps, filter));
}

double time_step_for_radius(double radius, int steps, const StepFilter& filter)
{
    return radius * radius * step_per_squared_radius(steps, filter);
}

double time_step_for_radius(const LengthOnMesh& radius, int steps, double diagonal, const StepFilter& filter)
{
    const double length = radius.value * (radius.of_diagonal ? diagonal : 1.0);
    const double time_step = time_step_for_radius(length, std::max(steps, 1), filter);
    if (std::isinf(time_step))
        throw OptionError("the radius is too large: the time step that it takes is beyond what a double can hold");
    if (!std::isnormal(time_step))
        throw InputError("has no size to measure a radius by; use a time step");
    return time_step;
}

double time_step_of(double time_step, const std::optional<LengthOnMesh>& radius, int steps, const PolygonMesh& mesh,
                    const StepFilter& filter)
{
    if (!radius)
        return time_step;
    if (radius->of_diagonal)
        require_valid(mesh, run_in_parallel);
    const double diagonal = radius->of_diagonal ? box_of_faces(mesh, run_in_parallel).diagonal() : 1.0;
    try {
        return time_step_for_radius(*radius, steps, diagonal, filter);
    } catch (const InputError& error) {
        throw InputError(Wording{"the mesh " + error.wording().text});
    }
}

}  // namespace seamflow
