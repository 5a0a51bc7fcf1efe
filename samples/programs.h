#pragma once

#include <array>
#include <string_view>

#include "samples/process/exit_status.h"

/// The programs that are also those of the Python package.
namespace seamflow {

/// Generates a mesh for experiments.
ExitStatus run_generate_program(int argc, char** argv);

/// Reports how far one mesh is from another: vertex to vertex, and vertex to surface.
ExitStatus run_compare_program(int argc, char** argv);

/// Reports the elements of a mesh and its defects, element by element.
/// @returns UnusableInput if `smooth` would not accept the file as it is.
ExitStatus run_inspect_program(int argc, char** argv);

inline constexpr std::array<std::string_view, 4> programs{"smooth", "inspect", "compare", "generate"};

/// Runs one of them.
/// @returns its exit status.
int run_program(std::string_view program, int argc, char** argv);

}  // namespace seamflow
