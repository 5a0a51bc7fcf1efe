#pragma once

namespace seamflow {

/// How far a flow smooths, as a length on the surface: bumps of this radius are half as high after all steps, smaller
/// ones lower yet, much larger ones hardly changed. A bump is one of z = a sin(πx/2R) sin(πy/2R), whose height each
/// backward Euler step divides by 1 + dt π²/(2R²) (to first order in a).
/// @param time_step in length². @param steps at least 1.
/// @returns R, in units of length.
double smoothed_radius(double time_step, int steps);

/// The time step, in length², with which that many steps smooth bumps of radius R: the inverse of smoothed_radius.
double time_step_for_radius(double radius, int steps);

}  // namespace seamflow
