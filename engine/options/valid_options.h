#pragma once

#include "engine/options/flow_options.h"

namespace seamflow {

/// Checks every field against its limits, and that the options go together.
/// @throws OptionError naming the field, its value and its limits, or the options that exclude each other; InputError
/// naming the face for a negative label, and naming the vertex for an attachment weight or a strength.
void require_valid(const FlowOptions& options);

}  // namespace seamflow
