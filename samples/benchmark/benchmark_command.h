#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samples/benchmark/methods/method.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// The task of `benchmark`.
enum class BenchmarkMode {
    /// Ours and the peers, on one mesh.
    Cell,
    /// The same for many meshes, time steps and numbers of steps: the fastest method.
    Grid,
    /// K-harmonic steps.
    KHarmonic,
    /// How ours chooses its approach.
    Explain,
    /// From file to file.
    WholeRun,
};

/// The meshes of a grid that are made have so many vertices, ten times as many, …
inline constexpr Index smallest_of_grid = 10'000;

/// The command line of `benchmark`: each mesh with each time step and each number of steps.
struct BenchmarkCommand {
    BenchmarkMode mode = BenchmarkMode::Cell;
    /// Kinds of meshes to make, with so many vertices; in a grid at most.
    std::vector<std::string> kinds{"triangles"};
    Index vertices = 100'000;
    /// Further meshes, to read.
    std::vector<std::filesystem::path> files;
    /// In squared mean edge lengths.
    std::vector<double> time_steps_edges{5.0};
    std::vector<int> steps{5};
    /// All else of the flow; `threads` at least 1.
    FlowOptions flow;
    std::vector<Method> peers;
    /// For BenchmarkMode::KHarmonic: the values of k.
    std::vector<int> orders{1, 2, 3};
    /// How often compared methods are run, in turns; the medians count.
    int turns = 3;
    /// Empty: none.
    std::filesystem::path json;
};

/// The peers that a word stands for: "none", "all", or comma-separated names (cholmod, cg, amg), each one once, in that
/// order.
/// @throws OptionError for another word.
std::vector<Method> peers_named(std::string_view word);

/// Parses the command line, and checks that the results can be written.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
/// @throws OptionError, OutputError (see output_files.h).
std::optional<ExitStatus> parse_benchmark_command(int argc, char** argv, BenchmarkCommand& command);

}  // namespace seamflow
