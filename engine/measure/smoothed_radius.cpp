#include "engine/measure/smoothed_radius.h"

#include <cmath>
#include <numbers>

namespace seamflow {

namespace {

/// dt / R² with which half of a bump is left after all steps.
double step_per_squared_radius(int steps, const StepFilter& filter)
{
    // A step multiplies the height by transfer(λ), λ = dt π² / (2 R²). A plain filter has the transfer 1 / (1 + λ).
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

}  // namespace seamflow
