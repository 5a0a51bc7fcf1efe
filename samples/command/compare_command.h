#pragma once

#include <filesystem>
#include <optional>

#include "samples/process/exit_status.h"
#include "samples/report/comparison.h"
#include "samples/report/error_map.h"

namespace seamflow {

/// The command line of `compare`.
struct CompareCommand {
    std::filesystem::path reference;
    std::filesystem::path candidate;
    Direction direction = Direction::ReferenceToCandidate;
    /// Files; empty: none.
    std::filesystem::path report;
    std::filesystem::path error_map;
    Shown shown = Shown::SurfaceDistance;
    /// The value with the last colour of the error map, in units of length.
    std::optional<double> full_scale;
};

/// Parses the command line and checks that the results can be written to the given paths.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
/// @throws OptionError, OutputError (see output_files.h).
std::optional<ExitStatus> parse_compare_command(int argc, char** argv, CompareCommand& command);

}  // namespace seamflow
