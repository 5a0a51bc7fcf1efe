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
    /// Folder for all results; made if it is not there.
    std::filesystem::path out;
    /// Whether to write a page for each figure.
    bool html = false;
    /// Names; empty: all.
    std::vector<std::string> figures;

    /// Whether a figure is to be made.
    [[nodiscard]] bool wants(std::string_view figure) const;
};

/// Parses the command line and makes the folder for the results.
/// @returns nothing to go on, or how to end: Success after --help, WrongUsage, said on standard error.
/// @throws OptionError for a figure that does not exist, InputError if there is no folder `meshes`, OutputError if the
///         folder `out` cannot be made or written to.
std::optional<ExitStatus> parse_figures_command(int argc, char** argv, FiguresCommand& command);

}  // namespace seamflow
