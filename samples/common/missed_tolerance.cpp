#include "samples/common/missed_tolerance.h"

namespace seamflow {

int steps_failed(const SmoothCommand& command, const FlowReport& report)
{
    if (!command.options.accuracy.tolerance)
        return 0;
    return command.limits_iterations ? report.steps_stagnated : report.steps_short_of_tolerance;
}

}  // namespace seamflow
