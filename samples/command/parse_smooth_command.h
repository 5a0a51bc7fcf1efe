#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// An option of `smooth` that is about the flow, and not about files or printed text.
struct FlowOptionText {
    /// Without hyphens before it.
    std::string name;
    /// The placeholder of its value in --help.
    std::string type;
    /// Its line in --help, and on further lines additional text for the manual page.
    std::string description;
    /// Whether it takes no value.
    bool is_flag = false;
    /// Whether it is about where the surface goes, so that fields have no such option.
    bool moves_surface = false;
};

/// All of them, one with two names twice.
std::vector<FlowOptionText> flow_options();

/// Parses only these options, for a mesh that is not in a file: `labels`, `fix` and `attach_weights` are those in
/// `words`, and nothing is read.
/// @param words as on a command line: "--radius=1%", "--plain".
/// @throws OptionError, also for errors that parse_smooth_command reports on standard error.
SmoothCommand parse_flow_options(const std::vector<std::string>& words);

}  // namespace seamflow
