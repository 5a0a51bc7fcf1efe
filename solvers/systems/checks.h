#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "partition/errors.h"

/// Checks of the equations of a sub-mesh. The messages of the errors say what the user can do.
namespace seamflow {

/// @throws ComputationError where a number is not finite.
inline void require_finite_equations(std::span<const double> values)
{
    if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
        throw ComputationError("the equations are not finite, because the time step is too large for the mesh or the "
                               "flow has collapsed a face or an edge: use a smaller time step or fewer steps");
}

/// @throws ComputationError if there is no factor.
template <class Factor>
Factor require_factor(std::optional<Factor> factor)
{
    if (!factor)
        throw ComputationError("the system is singular: use a smaller time step, or another Laplacian");
    return std::move(*factor);
}

/// @throws ComputationError where the result is not finite.
inline void require_finite_result(bool is_finite)
{
    if (!is_finite)
        throw ComputationError("the result is not finite: use a smaller time step");
}

}  // namespace seamflow
