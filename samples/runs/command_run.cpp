#include "samples/runs/command_run.h"

#include <string>

#include <fmt/format.h>

#include "partition/text.h"
#include "samples/process/exit_status.h"

namespace seamflow {

std::string missed_tolerance(const SmoothRequest& request, const ConvergenceReport& report)
{
    const std::optional<double>& tolerance = request.options.accuracy.tolerance;
    const int missed = request.limits_iterations ? report.steps_stagnated : report.steps_short_of_tolerance;
    return !tolerance || missed == 0 ? ""
                                     : fmt::format("the tolerance {} was missed in {}", *tolerance,
                                                   counted(static_cast<std::uint64_t>(missed), "step", "steps"));
}

ExitStatus require_converged(const SmoothCommand& command, const ConvergenceReport& report)
{
    const std::string missed = missed_tolerance(command, report);
    if (missed.empty())
        return ExitStatus::Success;
    say_error(command.program, fmt::format("{}; {} has the last state", missed, command.output.string()));
    return ExitStatus::ComputationFailed;
}

}  // namespace seamflow
