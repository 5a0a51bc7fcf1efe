#pragma once

#include "partition/vector_area.h"
#include "solvers/krylov/stopping_criterion.h"

namespace seamflow {

/// Result of the iteration for the equation on Γ, or for that of a whole mesh.
struct InterfaceResult : IterationResult {
    /// Estimate of the largest distance to the solution, in units of length.
    double estimated_distance = 0.0;
    /// Per coordinate, in the unit of the tolerance; `residual` is the largest.
    Point residuals = Point::Zero();
};

}  // namespace seamflow
