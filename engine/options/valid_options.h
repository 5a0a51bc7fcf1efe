#pragma once

#include "engine/options/flow_options.h"

namespace seamflow {

/// Checks every field against its limits.
/// @throws OptionError naming the field, its value and its limits; InputError naming the face for a negative label.
void require_valid(const FlowOptions& options);

}  // namespace seamflow
