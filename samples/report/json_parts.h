#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/measure/flow_report.h"
#include "partition/metrics/length_statistics.h"
#include "samples/report/run_record.h"
#include "samples/report/surface_change.h"

/// Parts that the reports of all programs share.
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

/// Of each: kind, numbers by name, and text in the words of programs.
ReportJson remarks_json(const std::vector<Remark>& remarks);

/// The text of a report. Names of files need not be valid UTF-8, but JSON must be.
std::string text_of(const ReportJson& json);

}  // namespace seamflow
