#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "samples/command/smooth_command.h"
#include "samples/process/exit_status.h"

namespace CLI {  // NOLINT(readability-identifier-naming)
class App;
}

namespace seamflow {

/// A program with the command line of `smooth`, or with most of it.
struct SmoothProgram {
    const char* name = "smooth";
    const char* description = "Smooths a mesh by mean curvature flow, cut into sub-meshes that are solved in parallel.";
    /// An option that it has not, and why.
    struct Lack {
        std::string option;
        const char* reason;
    };
    std::vector<Lack> lacks = {};
    /// Command lines that --help shows (see command_help.h); empty: those of `smooth`.
    std::string examples = {};
    /// Adds the options that it alone has.
    std::function<void(CLI::App&)> add_own = {};
    /// Whether it looks for the results' folders: of several processes one does.
    bool checks_files = true;
};

/// Parses the command line and checks that the results can be written where it says.
/// @returns nothing to go on, or how to end: Success after --help, WrongUsage, said on standard error.
/// @throws OptionError, OutputError (see output_files.h).
std::optional<ExitStatus> parse_smooth_command(int argc, char** argv, SmoothCommand& command,
                                               const SmoothProgram& program = {});

/// An option of `smooth` that is about the flow, and not about files or what is printed.
struct FlowOptionText {
    /// Without hyphens before it.
    std::string name;
    /// What stands for its value in --help.
    std::string type;
    /// Its line in --help, and on further lines what the manual page says beyond that.
    std::string description;
    /// Whether it takes no value.
    bool is_flag = false;
};

/// All of them in the order of --help, one with two names twice.
std::vector<FlowOptionText> flow_options();

/// Parses these options alone, for a mesh that is in no file: `labels`, `fix` and `attach_weights` are what `words`
/// say, and nothing is read.
/// @param words as on a command line: "--radius=1%", "--plain".
/// @throws OptionError, also for what parse_smooth_command says on standard error.
SmoothCommand parse_flow_options(const std::vector<std::string>& words);

/// How many steps have failed because they missed the tolerance: all that missed it, or, where the user has limited the
/// iterations, those that stagnated. 0 where the user has asked for no tolerance.
int steps_failed(const SmoothCommand& command, const ConvergenceReport& report);

}  // namespace seamflow
