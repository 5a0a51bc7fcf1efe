#pragma once

#include "samples/command/smooth_command.h"

/// The command line of `smooth` for what lives on a surface: fields that diffuse, and geodesic distances. The surface
/// itself stays.
namespace seamflow {

/// To be called when the command line was parsed, if it names fields or vertices to measure distances from.
/// @throws OptionError for options that move the surface, and without an amount for fields.
void require_fields(SmoothCommand& command);

}  // namespace seamflow
