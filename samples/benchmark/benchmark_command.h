#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samples/benchmark/benchmark_case.h"
#include "samples/process/exit_status.h"

namespace seamflow {

/// The task of `benchmark`.
enum class BenchmarkMode {
    /// One mesh, ours and the peers.
    Case,
    /// Meshes of 10⁴, 10⁵, … vertices.
    Scaling,
    /// One mesh, ours, with 1, 2, … threads.
    ThreadsSweep,
    /// One mesh, ours, its tasks replayed with numbers of threads that this machine need not have.
    SimulateThreads,
    /// One mesh, ours, shared by numbers of ranks that this machine need not have.
    SimulateRanks,
    /// Many meshes, time steps and numbers of steps: the fastest method.
    Grid,
    /// One mesh, k-harmonic steps.
    KHarmonic,
    /// One mesh, how ours chooses its approach.
    Explain,
    /// One mesh, from file to file.
    WholeRun,
    /// The same for meshes of 10⁴, 10⁵, … vertices.
    WholeRunScaling,
};

/// The cells of --grid: each mesh with each time step and each number of steps.
struct GridAxes {
    std::vector<std::string> kinds{"triangles", "quads", "hexagons", "mixed"};
    /// Further meshes, to read.
    std::vector<std::filesystem::path> files;
    /// In squared mean edge lengths.
    std::vector<double> time_steps_edges{1.0, 5.0, 50.0, 500.0};
    std::vector<int> steps{1, 3, 10};
};

/// The command line of `benchmark`.
struct BenchmarkCommand {
    /// A mesh to read; empty: one is generated.
    std::filesystem::path mesh;
    std::string kind = "triangles";
    Index vertices = 100'000;
    /// dt in squared mean edge lengths.
    double time_step_edges = 5.0;
    /// All except the time step, which follows from the mesh; `threads` at least 1.
    CaseOptions options;
    BenchmarkMode mode = BenchmarkMode::Case;
    GridAxes grid;
    /// For BenchmarkMode::SimulateThreads, in GB/s; 0: as measured.
    double memory_bandwidth = 0.0;
    /// For BenchmarkMode::KHarmonic: the values of k.
    std::vector<int> orders{1, 2, 3};
    /// For BenchmarkMode::SimulateRanks.
    std::vector<int> simulated_ranks;
    /// How often compared methods are run, in turns; the medians count.
    int turns = 3;
    /// Files and folders; empty: none.
    std::filesystem::path json;
    std::filesystem::path export_folder;
};

/// The peers that a word stands for: "none", comma-separated names (cholmod, umfpack, cg, cg-ic, amg, cgal, and of ours
/// sweep, converged, our-cg, undecomposed), each one once, in that order; or "all" that are not ours.
/// @throws OptionError for another word.
std::vector<Method> peers_named(std::string_view word);

/// The numbers of threads, or of ranks, that a word stands for: "all" (1, 2, 4, … 1024), or comma-separated numbers.
/// @param option its name, for the message. @throws OptionError for another word.
std::vector<int> numbers_named(std::string_view word, std::string_view option);

/// Parses the command line, makes the folder of --export, and checks that the results can be written.
/// @returns empty to continue, else how to end: Success after --help, WrongUsage, reported on standard error.
/// @throws OptionError, OutputError (see output_files.h).
std::optional<ExitStatus> parse_benchmark_command(int argc, char** argv, BenchmarkCommand& command);

}  // namespace seamflow
