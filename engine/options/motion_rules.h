#pragma once

#include "engine/options/motion_options.h"
#include "engine/options/option_rule.h"

namespace seamflow {

/// Checks which constraints on motion go together.
/// @throws OptionError
void require_compatible(const MotionOptions& motion, const AskedOptions& asked);

/// Checks the numbers of each vertex.
/// @throws InputError naming the vertex.
void require_valid_vertex_values(const MotionOptions& motion);

}  // namespace seamflow
