#pragma once

#include <filesystem>

#include "engine/flow_report.h"

namespace seamflow {

/// Writes the schedule of a flow in the Trace Event Format that ui.perfetto.dev and chrome://tracing show: a row for
/// the steps, in each of which `join` follows the last task, and a row per thread with a slice per task, named by phase
/// and sub-mesh; arrows for the dependencies.
/// @param report with a schedule.
/// @throws OutputError naming the file.
void write_schedule_trace(const std::filesystem::path& path, const FlowReport& report);

}  // namespace seamflow
