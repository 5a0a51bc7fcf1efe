#pragma once

#include "partition/vector_area.h"
#include "solvers/krylov/stopping_criterion.h"

namespace seamflow {

/// The result of the iteration for the equation on Γ, or for the equation of a whole mesh.
struct InterfaceResult : IterationResult {
    /// Estimate of the largest distance to the solution, in units of length.
    double estimated_distance = 0.0;
    /// The residual of each coordinate, in the unit of the tolerance; `residual` is the largest of them.
    Point residuals = Point::Zero();
};

}  // namespace seamflow
