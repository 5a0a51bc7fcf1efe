#pragma once

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// How far a flow smooths, as a length on the surface: bumps of this radius are half as high after all steps, smaller
/// ones lower yet, much larger ones hardly changed. A bump is one of z = a sin(πx/2R) sin(πy/2R), whose height each
/// backward Euler step divides by 1 + dt π²/(2R²) (to first order in a).
/// @param time_step in length². @param steps at least 1.
/// @returns R, in units of length.
double smoothed_radius(double time_step, int steps);

/// The time step, in length², with which that many steps smooth bumps of radius R: the inverse of smoothed_radius.
double time_step_for_radius(double radius, int steps);

/// The same for a radius that may be measured by the mesh.
/// @param steps with 0 the time step is that of one. @param diagonal of the bounding box, in units of length.
/// @throws InputError for a mesh that has no size to measure by, without naming it: "has no size …"; OptionError for a
///         time step that no double can hold.
double time_step_for_radius(const LengthOnMesh& radius, int steps, double diagonal);

/// FlowOptions::time_step, or what FlowOptions::radius takes, in length².
/// @throws InputError for a mesh that is not valid; as time_step_for_radius.
double time_step_of(const FlowOptions& options, const PolygonMesh& mesh);

}  // namespace seamflow
