#include "samples/runs/run_output.h"

#include <iostream>
#include <string>

#include "partition/io/input_file.h"
#include "samples/runs/smoothing_run.h"

namespace seamflow {

std::ostream& message_stream(const SmoothCommand& command)
{
    static std::ostream silence(nullptr);
    const bool is_taken = is_standard_stream(command.output) || is_standard_stream(command.report);
    return command.quiet ? silence : is_taken ? std::cerr : std::cout;
}

ExitStatus require_converged(const SmoothCommand& command, const ConvergenceReport& report)
{
    const std::string missed = missed_tolerance(command, report);
    if (missed.empty())
        return ExitStatus::Success;
    std::cerr << command.program << ": " << missed << "; " << command.output.string() << " has the last state\n";
    return ExitStatus::ComputationFailed;
}

}  // namespace seamflow
