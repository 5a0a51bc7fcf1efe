#pragma once

#include "engine/options/flow_report.h"
#include "samples/common/smooth_command.h"

namespace seamflow {

/// How many steps have failed because they missed the tolerance: all that missed it, or, where the user has limited the
/// iterations, those that stagnated. 0 where the user has asked for no tolerance.
int steps_failed(const SmoothCommand& command, const FlowReport& report);

}  // namespace seamflow
