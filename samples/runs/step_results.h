#pragma once

#include <iosfwd>
#include <optional>

#include "engine/measure/run_report.h"
#include "samples/command/smooth_command.h"
#include "samples/files/mesh_results.h"
#include "samples/page/page_flow.h"

namespace seamflow {

/// Prints every step, writes it where --every-step asks for that, and hands it to the page.
/// @param steps what --every-step writes; empty without it.
/// @param write_seconds gets the time that writing takes.
StepObserver show_and_write_steps(const SmoothCommand& command, const std::optional<MeshOutput>& steps,
                                  const PolygonMesh& input, double mean_edge, double& write_seconds,
                                  std::optional<PageFlow>& page, std::ostream& out, const Executor& exec);

}  // namespace seamflow
