#pragma once

#include <cmath>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The fraction of a disturbance at one point that reaches another point in one backward Euler step of diffusion on a
/// line: e^-θ with cosh θ = 1 + d² / (2 dt), d being the distance of the points.
/// @param time_step dt, in length².
inline double remainder_between(const Points& positions, Index from, Index to, double time_step)
{
    const double squared_distance = (positions.row(to) - positions.row(from)).squaredNorm();
    const double cosh = 1.0 + 0.5 * squared_distance / time_step;
    return 1.0 / (cosh + std::sqrt((cosh - 1.0) * (cosh + 1.0)));
}

}  // namespace seamflow
