#pragma once

#include <string>
#include <string_view>

#include "engine/options/flow_options.h"
#include "engine/options/option_rule.h"

namespace seamflow {

/// The options of a flow that are asked for: all that differ from their defaults.
AskedOptions changed_options(const FlowOptions& options);

/// Completes the text of a rule on flows: {other} becomes `other`; {laplacian}, {approach}, {conditions} and
/// {factorisation} the values in `options`; {symmetric} the list of symmetric Laplacians; {further} the option that
/// makes the flow another one than plain mean curvature flow.
/// @param other the option that the rule excludes, or empty.
std::string fill_in(const FlowOptions& options, std::string_view text, std::string_view other);

/// Checks which options of a flow go together.
/// @throws OptionError
void require_compatible(const FlowOptions& options, const AskedOptions& asked);

}  // namespace seamflow
