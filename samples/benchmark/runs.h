#pragma once

#include <iosfwd>

#include <nlohmann/json.hpp>

#include "samples/benchmark/benchmark_command.h"

namespace seamflow {

/// Runs a command: each mesh with each time step and each number of steps. Prints the table as it grows.
/// @returns the rows of the table, for --json: one for each line, with a member for each column and some more.
/// @throws InputError, OptionError, OutputError, ComputationError as its parts.
nlohmann::ordered_json run_benchmark(const BenchmarkCommand& command, std::ostream& out);

}  // namespace seamflow
