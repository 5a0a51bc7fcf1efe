#pragma once

/// What goes wrong with the equations of a sub-mesh, and what to do about it.
namespace seamflow {

inline constexpr const char* equations_not_finite =
    "the equations are not finite, because the time step is too large for the mesh or the flow has taken a face's area "
    "or an edge's length: use a smaller time step or fewer steps";

inline constexpr const char* system_singular = "the system is singular: use a smaller time step, or another Laplacian";

inline constexpr const char* result_not_finite = "the result is not finite: use a smaller time step";

}  // namespace seamflow
