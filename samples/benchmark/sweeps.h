#pragma once

#include <iosfwd>

#include <nlohmann/json.hpp>

#include "samples/benchmark/benchmark_command.h"

namespace seamflow {

/// Runs a command. Prints the tables as they grow.
/// @returns the contents for --json: of one case, simulated or not, as case_json; of --explain as explanation_json; of
///          --scaling, --threads-sweep, --grid and --whole-run {"scaling": […]}, {"threads_sweep": […]}, {"grid": […]}
///          and {"whole_runs": […]}, one case, cell or run after the other.
/// @throws InputError, OptionError, OutputError, ComputationError as its parts.
nlohmann::ordered_json run_benchmark(const BenchmarkCommand& command, std::ostream& out);

}  // namespace seamflow
