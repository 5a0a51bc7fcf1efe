#include "engine/measure/smoothed_radius.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partition/errors.h"

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
    const double time_step = time_step_for_radius(scale.length_of(*amount.radius), std::max(steps, 1), filter);
    if (std::isinf(time_step))
        throw OptionError("the radius is too large: the time step that it takes is beyond what a double can hold");
    if (!std::isnormal(time_step))
        throw InputError("the mesh has no size to measure a radius by; use a time step");
    return time_step;
}

}  // namespace seamflow
