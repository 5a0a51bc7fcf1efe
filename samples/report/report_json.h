#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/measure/flow_report.h"
#include "partition/inspection/mesh_inspection.h"
#include "partition/io/fault_log.h"
#include "partition/metrics/length_statistics.h"
#include "samples/options/smooth_surface.h"
#include "samples/process/exit_status.h"
#include "samples/report/comparison.h"
#include "samples/report/run_record.h"
#include "samples/report/surface_change.h"
#include "samples/report/surface_roughness.h"

/// The reports of programs as JSON, and the parts that they share.
namespace seamflow {

/// Must be raised whenever a key of a report is removed or changes its meaning.
inline constexpr int report_schema = 3;

using ReportJson = nlohmann::ordered_json;

/// A report's first keys: its schema, the version of the program, the date (UTC), the files and arguments of the run.
ReportJson begin_report(const RunRecord& run);

/// Null for a number that is not finite.
ReportJson json_number(double value);

/// NAME_mean, NAME_rms and NAME_max in some unit, with an ending.
void add_lengths(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double unit,
                 const char* ending = "");

/// The same in units of `mean_edge`, and with the ending _absolute in units of length.
void add_statistics(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double mean_edge);

/// With a tolerance: it, and how many steps have missed it.
void add_convergence(ReportJson& json, const ConvergenceReport& convergence);

/// What each rank has had of the flow, if ranks have shared it.
void add_ranks(ReportJson& json, const std::vector<RankRecord>& ranks);

/// Area, volume, volumes of cells, if there are any, roughness and, where they were counted, crossing faces.
ReportJson look_json(const SurfaceLook& look);

/// Of each: kind, numbers by name, and text.
ReportJson remarks_json(const std::vector<RemarkInWords>& remarks);

/// The text of a report. Names of files need not be valid UTF-8, but JSON must be.
std::string text_of(const ReportJson& json);

/// REPORT.json of `smooth` and `smooth-distributed`. All numbers read back to the same double; a number that is not
/// finite becomes null. v_mean, v_rms and v_max are in mean edge lengths of the undecomposed flow's mesh,
/// v_mean_absolute and so on in units of length; displacements are in mean edge lengths of the input.
/// @param run complete (see complete_record). @param options with the amount.
std::string smooth_report_json(const RunRecord& run, const AllOptions& options, const SmoothReport& report);

/// STEPS.csv of --csv: one row per step, with all keys of steps in the report, and the smallest and the largest Robin
/// parameter p of sub-meshes, in 1/length. A cell is empty if there is no such number.
/// @param report that of `smooth` or `smooth-distributed`, as JSON.
std::string steps_csv(std::string_view report);

/// REPORT.json of a run that has failed: the files, the arguments and the error.
std::string smooth_failure_json(const RunRecord& run, const Failure& failure);

/// REPORT.json of `compare`; the same units. Values that were not measured have no keys.
std::string compare_report_json(const Comparison& comparison);

/// All findings of `inspect`, as it prints them with --json.
/// @param roughness without noise if it is not measured: then it has no keys.
std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found,
                            const SurfaceRoughness& roughness);

}  // namespace seamflow
