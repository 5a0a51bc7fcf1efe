#include "samples/runs/command_run.h"

#include <filesystem>
#include <iostream>
#include <string>

#include "partition/formats/index_files.h"
#include "partition/io/input_file.h"
#include "samples/files/output_files.h"
#include "samples/runs/smoothing_run.h"

namespace seamflow {

std::vector<double> read_region(const SmoothCommand& command, Index n_vertices)
{
    if (command.region.empty())
        return {};
    if (std::filesystem::exists(command.region))
        return read_vertex_strengths(command.region, n_vertices, command.region_property);
    return read_vertex_strengths(command.input, n_vertices, command.region.string());
}

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
