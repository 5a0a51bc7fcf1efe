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

/// Data passed from step to step: always positions; the rest depends on the stepper.
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

    /// @throws InputError if there is no further array, or it has another number of rows, or non-finite numbers.
    const Points& array(Eigen::Index rows);

    /// The same for an array of any numbers.
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

/// Everything a flow needs to resume after a complete step as if it had never ended: see StepState::capture and
/// FlowControl::resume. It belongs to the mesh as it was before the first step, and to the options.
struct FlowState {
    /// See identify; 0: it was not needed.
    std::uint64_t identity = 0;
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
    /// #V by 3, as the flow itself continues with them: unscaled if MotionOptions::rescale scales only results.
    [[nodiscard]] const Points& positions() const { return flow.positions; }
};

}  // namespace seamflow
