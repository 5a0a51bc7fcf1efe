#pragma once

#include "engine/flow_report.h"
#include "samples/common/smooth_command.h"

namespace seamflow {

/// How many steps have failed because they missed the tolerance that the user has asked for: those that iterations have
/// not been enough for which the user has not limited, and those that more would not have helped. A tolerance that
/// nobody has asked for is none to fail by; of it the remark in the report says enough.
int steps_failed(const SmoothCommand& command, const FlowReport& report);

}  // namespace seamflow
