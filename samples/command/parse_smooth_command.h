#pragma once

#include <optional>
#include <string>

#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// A program with the command line of `smooth`.
struct SmoothProgram {
    const char* name = "smooth";
    const char* description = "Smooths a mesh by mean curvature flow, cut into sub-meshes that are solved in parallel.";
    /// Command lines that --help shows (see command_help.h); empty: those of `smooth`.
    std::string examples = {};
    /// What --help says of --approach; empty: as of `smooth`.
    std::string approaches = {};
};

/// Parses the command line and checks that the results can be written to the given paths.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
/// @throws OptionError, OutputError (see output_files.h).
std::optional<ExitStatus> parse_smooth_command(int argc, char** argv, SmoothCommand& command,
                                               const SmoothProgram& program = {});

}  // namespace seamflow
