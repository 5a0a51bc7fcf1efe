#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/measure/displacement_meter.h"
#include "engine/measure/run_report.h"
#include "engine/options/approach.h"
#include "engine/state/step_memory.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// All data that a flow needs to resume after a complete step as if it had never ended: see StepState::capture and
/// FlowControl::resume. The state belongs to the mesh as it was before the first step, and to the options.
struct FlowState {
    /// The checksum of the mesh and of the options that determine results (see identify); 0: it was not computed.
    std::uint64_t identity = 0;
    /// The way in which the steps are taken.
    Approach approach = Approach::Sweep;
    /// The checksum of the labels of the cut.
    std::uint64_t cut = 0;
    /// The reports on the steps so far, and their times in seconds, as in the FlowReport.
    std::vector<StepReport> steps;
    PhaseSeconds seconds;
    DisplacementSums displacement;
    StepMemory flow = {};
    /// The memory of the undecomposed flow, with ReportOptions::reference.
    std::optional<StepMemory> reference = {};

    [[nodiscard]] int n_steps() const { return static_cast<int>(steps.size()); }
    /// #V by 3: the positions from which the flow continues: unscaled if MotionOptions::rescale scales only results.
    [[nodiscard]] const Points& positions() const { return flow.positions; }
};

/// @throws InputError if the state is of another identity (see identify).
void require_identity(const FlowState& state, std::uint64_t identity);

/// @throws OptionError if the state is after more steps than are asked for.
void require_not_beyond(const FlowState& state, int steps);

}  // namespace seamflow
