#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samples/process/exit_status.h"

namespace seamflow {

/// The command line of `figures`.
struct FiguresCommand {
    /// Folder with the authors' files; empty: none.
    std::filesystem::path meshes;
    /// Folder for all results; created if it does not exist.
    std::filesystem::path out;
    /// Whether to write a page for each figure.
    bool html = false;
    /// Names; empty: all.
    std::vector<std::string> figures;

    /// Whether to make a figure.
    [[nodiscard]] bool wants(std::string_view figure) const;
};

/// Parses the command line and makes the folder for the results.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
/// @throws OptionError for a figure that does not exist, InputError if there is no folder `meshes`, OutputError if the
///         folder `out` cannot be made or written to.
std::optional<ExitStatus> parse_figures_command(int argc, char** argv, FiguresCommand& command);

}  // namespace seamflow
