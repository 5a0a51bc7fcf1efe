#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "samples/options/smooth_surface.h"
#include "samples/report/comparison.h"
#include "samples/report/error_map.h"
#include "samples/report/run_record.h"

namespace seamflow {

/// Prints the input.
void print_input(std::ostream& out, const RunRecord& run, std::int64_t n_vertices, std::int64_t n_faces);

/// Prints the input, the choices of a preset, if one was used, and the amount of smoothing in all units in which it can
/// be given.
/// @param options resolved.
void print_start(std::ostream& out, const RunRecord& run, std::int64_t n_vertices, std::int64_t n_faces,
                 const AllOptions& options);

/// One line for a step.
/// @param step its number, from 1, of `steps`.
/// @param mean_edge of the input; the unit of printed gaps.
void print_step(std::ostream& out, const StepReport& report, int step, int steps, double mean_edge);

/// Prints how steps were taken: the cut, factors, the time per task and displacements.
void print_details(std::ostream& out, const RunRecord& run, const AllOptions& options, const SmoothReport& report);

/// Prints how many vertices each rank had, or that there was nothing for others to do.
/// @param n_ranks that were started.
void print_ranks(std::ostream& out, const RunRecord& run, int n_ranks);

/// How long the parts of a run took, which add up to the whole: "time       1.2 s: read 0.1, …".
std::string time_of(const RunRecord& run, const PhaseSeconds& phases);

/// Prints how steps are taken, in a line.
void print_choices(std::ostream& out, const std::vector<RemarkInWords>& choices);

/// Prints a line for each remark.
void print_remarks(std::ostream& out, const std::vector<RemarkInWords>& remarks);

/// "moved 0.1 (0.2 mean edge lengths) on average, 1 (2) at most".
/// @param moved, mean_edge in length.
std::string moved_in_words(const LengthStatistics& moved, double mean_edge);

/// Prints choices with reasons, remarks, time and memory, where the result is, and how it differs from the input.
void print_result(std::ostream& out, const RunRecord& run, const SmoothReport& report);

/// Prints the results of `compare`, absolute and in mean edge lengths of the reference; displacements only in these.
void print_comparison(std::ostream& out, const Comparison& comparison);

/// Prints the path of an error map and the meaning of its colours.
void print_error_map(std::ostream& out, const std::string& file, const ErrorRange& range);

}  // namespace seamflow
