#pragma once

#include <filesystem>

#include "engine/measure/flow_report.h"

namespace seamflow {

/// Writes the schedule of a flow in the Trace Event Format that ui.perfetto.dev and chrome://tracing show: a row for
/// the steps, in each of which `join` follows the last task, and a row per thread with a slice per task, named by phase
/// and sub-mesh; arrows for the dependencies.
/// @param report with a schedule.
/// @throws OutputError naming the file.
void write_schedule_trace(const std::filesystem::path& path, const FlowReport& report);

/// Writes the task graph of a flow in the language of Graphviz: a node for each task, named by phase and sub-mesh, an
/// arrow to each task that waits for it. Alternating sweeps are two graphs in one drawing.
/// @param report with a schedule.
/// @throws OutputError naming the file.
void write_task_graph(const std::filesystem::path& path, const FlowReport& report);

}  // namespace seamflow
