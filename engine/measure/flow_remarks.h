#pragma once

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"

namespace seamflow {

/// Adds a remark if the estimated distance to the undecomposed flow after the last step is above a mean edge length.
void remark_on_drift(FlowReport& report);

/// Adds a remark if equations of sub-meshes were nearly singular.
void remark_on_near_singularity(FlowReport& report);

/// Adds a remark if sub-meshes could not use the factorisation that was asked for.
void remark_on_factorisation(Factorisation asked, FlowReport& report);

/// Adds a remark if steps have missed the tolerance, by their number in the report.
/// @param iterations the largest number that a step may take.
void remark_on_missed_tolerance(int iterations, FlowReport& report);

}  // namespace seamflow
