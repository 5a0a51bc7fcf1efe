#include "engine/setup/smoothing_amount.h"

#include <cmath>
#include <numbers>

namespace seamflow {

namespace {

/// dt / R²: what (1 + dt π²/(2R²))^steps = 2 leaves.
double step_per_squared_radius(int steps)
{
    return 2.0 * std::expm1(std::numbers::ln2 / steps) / (std::numbers::pi * std::numbers::pi);
}

}  // namespace

double smoothed_radius(double time_step, int steps)
{
    return std::sqrt(time_step / step_per_squared_radius(steps));
}

double time_step_for_radius(double radius, int steps)
{
    return radius * radius * step_per_squared_radius(steps);
}

}  // namespace seamflow
