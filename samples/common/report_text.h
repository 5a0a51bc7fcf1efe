#pragma once

#include <iosfwd>

#include "engine/flow_report.h"
#include "samples/common/run_record.h"

namespace seamflow {

/// What was read.
void print_input(std::ostream& out, const RunRecord& run, const PolygonMesh& mesh);

/// One line for a step.
/// @param step its number, from 1, of `steps`.
void print_step(std::ostream& out, const StepReport& report, int step, int steps);

/// What the flow did: the cut, the time per phase, memory, remarks and where the result is.
void print_summary(std::ostream& out, const RunRecord& run, const FlowReport& report);

/// What `compare` found, absolute and in mean edge lengths of the reference.
void print_comparison(std::ostream& out, const Comparison& comparison);

}  // namespace seamflow
