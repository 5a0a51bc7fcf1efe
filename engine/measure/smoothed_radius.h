#pragma once

#include "solvers/filters/step_filter.h"

namespace seamflow {

/// The length on the surface over which a flow smooths: bumps of this radius have half their height after all steps;
/// smaller bumps have less, much larger ones hardly change. A bump is z = a sin(πx/(2R)) sin(πy/(2R)), whose height
/// each step multiplies by the filter's transfer(dt π²/(2R²)), to first order in a. With Laplacian::Uniform that holds
/// where edges are as long as its h.
/// @param time_step in length². @param steps at least 1.
/// @param filter of each step.
/// @returns R, in units of length.
double smoothed_radius(double time_step, int steps, const StepFilter& filter = {});

/// The time step, in length², with which that many steps smooth bumps of radius R: the inverse of smoothed_radius.
double time_step_for_radius(double radius, int steps, const StepFilter& filter = {});

}  // namespace seamflow
