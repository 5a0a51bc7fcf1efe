#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "partition/metrics/length_statistics.h"
#include "samples/report/run_record.h"
#include "samples/report/surface_change.h"

/// What the reports of all programs have in common.
namespace seamflow {

/// To be raised whenever a key of a report goes or means something else.
inline constexpr int report_schema = 1;

using ReportJson = nlohmann::ordered_json;

/// A report's first keys: its schema, the version of the program, the date (UTC), and what the run was asked for.
ReportJson begin_report(const RunRecord& run);

/// Null for a number that is not finite.
ReportJson json_number(double value);

/// NAME_mean, NAME_rms and NAME_max in units of `mean_edge`; with _absolute behind them in units of length.
void add_statistics(ReportJson& json, const std::string& name, const LengthStatistics& lengths, double mean_edge);

/// Area, volume, roughness and, where they were counted, crossing faces.
ReportJson look_json(const SurfaceLook& look);

/// The text of a report. Names of files need not be valid UTF-8, JSON must.
std::string text_of(const ReportJson& json);

}  // namespace seamflow
