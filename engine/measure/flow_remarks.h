#pragma once

#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"

namespace seamflow {

/// Adds what the estimate after the last step means for the user, if it means anything.
void remark_on_drift(FlowReport& report);

/// Adds a remark where equations were nearly singular.
void remark_on_near_singularity(FlowReport& report);

/// Adds a remark if sub-meshes could not use the factorisation that was asked for.
void remark_on_factorisation(Factorisation asked, FlowReport& report);

/// Adds a remark where steps have missed the tolerance, as the report says.
/// @param iterations the most that a step may have.
void remark_on_missed_tolerance(int iterations, FlowReport& report);

}  // namespace seamflow
