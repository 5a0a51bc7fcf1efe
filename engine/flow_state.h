#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/flow_identity.h"
#include "engine/flow_report.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// What a way of taking steps hands from one to the next. What there is besides positions depends on it.
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

    /// The same for an array with that many rows or none.
    const Points& array_or_none(Eigen::Index rows);

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

/// Sums over the steps so far (see TotalDisplacement): of the tangential parts, #V by 3, and of the lengths of both
/// parts, #V, not a number where they are not defined.
struct DisplacementSums {
    Points drift = Points(0, 3);
    std::vector<double> tangential;
    std::vector<double> normal;
};

/// Everything that a flow needs to go on after a complete step as if it had never ended: see StepState::capture and
/// FlowControl::resume. It belongs to the mesh as it was before the first step, and to the options.
struct FlowState {
    FlowIdentity identity;
    /// Checksum of the cut.
    std::uint64_t cut = 0;
    /// As in the FlowReport: one for each step so far, and their seconds.
    std::vector<StepReport> steps;
    PhaseSeconds seconds;
    DisplacementSums displacement;
    StepMemory flow = {};
    /// Of the undecomposed flow, with FlowOptions::reference.
    std::optional<StepMemory> reference = {};

    [[nodiscard]] int n_steps() const { return static_cast<int>(steps.size()); }
    /// #V by 3, as the flow itself goes on with them: without FlowOptions::rescale.
    [[nodiscard]] const Points& positions() const { return flow.positions; }
};

}  // namespace seamflow
