#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "engine/tasks/schedule_simulation.h"
#include "samples/report/comparison.h"
#include "samples/report/error_map.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// What was read.
void print_input(std::ostream& out, const RunRecord& run, std::int64_t n_vertices, std::int64_t n_faces);

/// What a preset has chosen, if one has.
/// @param options that say the same.
void print_preset(std::ostream& out, const RunRecord& run, const std::string& options);

/// How much the flow is to smooth, in all units that it can be asked for in.
void print_amount(std::ostream& out, const MeshScale& scale, const FlowOptions& options);

/// One line for a step.
/// @param step its number, from 1, of `steps`.
/// @param mean_edge of the input; gaps are printed in it.
void print_step(std::ostream& out, const StepReport& report, int step, int steps, double mean_edge);

/// How steps were taken: the cut, factors, the time per task and displacements.
void print_details(std::ostream& out, const RunRecord& run, const FlowReport& report);

/// What was chosen and why, remarks, time and memory, where the result is, and how it differs from the input.
void print_result(std::ostream& out, const RunRecord& run, const FlowReport& report);

/// What `compare` found, absolute and in mean edge lengths of the reference; displacements in the latter alone.
void print_comparison(std::ostream& out, const Comparison& comparison);

/// Where an error map is, and what its colours mean.
void print_error_map(std::ostream& out, const std::string& file, const ErrorRange& range);

/// A table with one line per simulation: workers, makespan, efficiency, speed-up and critical path, times in
/// milliseconds.
void print_simulations(std::ostream& out, const std::vector<Simulation>& simulations);

}  // namespace seamflow
