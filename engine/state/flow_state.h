#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/measure/displacement_meter.h"
#include "engine/measure/flow_report.h"
#include "engine/state/flow_identity.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// What one step hands to the next. Positions always; the rest depends on the stepper.
struct StepMemory {
    /// #V by 3, after the last complete step.
    Points positions = Points(0, 3);
    std::vector<Points> arrays;
    std::vector<double> numbers;
};

/// Takes out of a StepMemory what was put in, in the same order.
class StepMemoryReader {
  public:
    explicit StepMemoryReader(const StepMemory& memory)
        : memory_(&memory)
    {
    }

    /// @throws InputError if there is no further array, or it has not that many rows, or numbers that are not finite.
    const Points& array(Eigen::Index rows);

    /// The same for an array whose numbers may be any.
    const Points& array_of_any(Eigen::Index rows);

    /// @throws InputError if there is no further number.
    double number();

    /// The same for a number that counts something.
    int count();

    /// @throws InputError if anything is left.
    void require_end() const;

  private:
    const StepMemory* memory_;
    std::size_t next_array_ = 0;
    std::size_t next_number_ = 0;
};

/// Everything that a flow needs to go on after a complete step as if it had never ended: see StepState::capture and
/// FlowControl::resume. It belongs to the mesh as it was before the first step, and to the options.
struct FlowState {
    FlowIdentity identity;
    /// How its steps are taken.
    Approach approach = Approach::Sweep;
    /// Checksum of the cut.
    std::uint64_t cut = 0;
    /// As in the FlowReport: one for each step so far, and their seconds.
    std::vector<StepReport> steps;
    PhaseSeconds seconds;
    DisplacementSums displacement;
    StepMemory flow = {};
    /// Of the undecomposed flow, with ReportOptions::reference.
    std::optional<StepMemory> reference = {};

    [[nodiscard]] int n_steps() const { return static_cast<int>(steps.size()); }
    /// #V by 3, as the flow itself goes on with them: unscaled where MotionOptions::rescale scales results alone.
    [[nodiscard]] const Points& positions() const { return flow.positions; }
};

}  // namespace seamflow
