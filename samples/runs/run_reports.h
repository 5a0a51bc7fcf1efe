#pragma once

#include <optional>
#include <vector>

#include "engine/tasks/workers.h"
#include "partition/formats/mesh_file.h"
#include "samples/command/smooth_command.h"
#include "samples/options/smooth_surface.h"
#include "samples/page/page_flow.h"
#include "samples/report/run_record.h"

/// The reports on a run that the command line names: report, rows of steps, trace, task graph and page.
namespace seamflow {

/// The page of --html, so far the input; empty without --html.
/// @param left_out ascending: the faces of the file that are not in the mesh.
/// @param workers pack the mesh.
/// @throws OutputError for a mesh that no page can show.
std::optional<PageFlow> begin_page(const SmoothCommand& command, const MeshFile& file,
                                   const std::vector<Index>& left_out, Workers& workers);

/// Writes the reports.
/// @param run complete (see complete_record).
/// @throws OutputError
void write_reports(const SmoothCommand& command, const RunRecord& run, const SmoothReport& report,
                   std::optional<PageFlow>& page);

}  // namespace seamflow
