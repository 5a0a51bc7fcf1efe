#pragma once

#include <optional>

#include "samples/command/smooth_command.h"
#include "samples/options/smooth_surface.h"
#include "samples/page/page_flow.h"
#include "samples/report/run_record.h"

/// The reports on a run that the command line names: report, rows of steps, trace, task graph and page.
namespace seamflow {

/// Writes the reports, and completes the page.
/// @param run complete (see complete_record).
/// @throws OutputError
void write_reports(const SmoothCommand& command, const RunRecord& run, const SmoothReport& report,
                   std::optional<PageFlow>& page);

}  // namespace seamflow
