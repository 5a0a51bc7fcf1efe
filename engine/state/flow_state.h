#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/measure/displacement_meter.h"
#include "engine/measure/flow_report.h"
#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Data passed from step to step: the positions, and further data that depend on the stepper.
struct StepMemory {
    /// #V by 3, after the last complete step.
    Points positions = Points(0, 3);
    std::vector<Points> arrays;
    std::vector<double> numbers;
};

/// Reads a StepMemory in the order in which it was written.
class StepMemoryReader {
  public:
    explicit StepMemoryReader(const StepMemory& memory)
        : memory_(&memory)
    {
    }

    /// Returns the next array.
    /// @throws InputError if there is no further array, or it has another number of rows, or non-finite numbers.
    const Points& array(Eigen::Index rows);

    /// Returns the next array, whose numbers need not be finite.
    const Points& array_of_any(Eigen::Index rows);

    /// Returns the next number.
    /// @throws InputError if there is no further number.
    double number();

    /// Returns the next number, which must be a count.
    int count();

    /// @throws InputError if any data are left.
    void require_end() const;

  private:
    const StepMemory* memory_;
    std::size_t next_array_ = 0;
    std::size_t next_number_ = 0;
};

/// All data that a flow needs to resume after a complete step as if it had never ended: see StepState::capture and
/// FlowControl::resume. The state belongs to the mesh as it was before the first step, and to the options.
struct FlowState {
    /// See identify; 0: no identity was computed.
    std::uint64_t identity = 0;
    /// The way in which the steps are taken.
    Approach approach = Approach::Sweep;
    /// The checksum of the cut.
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

}  // namespace seamflow
