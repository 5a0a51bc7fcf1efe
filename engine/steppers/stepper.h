#pragma once

#include "engine/options/flow_report.h"
#include "engine/state/flow_state.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Takes the steps of a flow, one after the other: each from Vᵏ to Vᵏ⁺¹. How it does so is its own affair (see
/// make_stepper for the ways there are). Belongs to the arena in which it is constructed.
class Stepper {
  public:
    Stepper() = default;
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;
    virtual ~Stepper() = default;

    /// One step. After an exception there are no positions, and the stepper is at its end.
    /// @param before #V by 3: Vᵏ, which is what positions() is or was, in memory of its own.
    /// @throws ComputationError naming the sub-mesh; Cancelled.
    virtual void step(const Points& before) = 0;

    /// #V by 3, after the last step.
    [[nodiscard]] virtual const Points& positions() const = 0;

    /// The sub-meshes after the last step (see FlowReport::separated); null where they have no copies of their own of Γ,
    /// and without ReportOptions::keep_gaps.
    [[nodiscard]] virtual const PolygonMesh* separated() const { return nullptr; }

    /// Gives what the next step needs.
    virtual void save(StepMemory& memory) const = 0;

    /// Takes that back, before any step: the next one goes on from there.
    /// @throws InputError if it does not fit.
    virtual void restore(const StepMemory& memory) = 0;

    /// Adds the seconds spent in tasks.
    virtual void add_seconds(PhaseSeconds& seconds) const = 0;

    /// Fills in what is known of the last step.
    virtual void describe(StepReport& report) const = 0;

    /// Fills in what is known of all steps: sub-meshes, colours, seconds spent in tasks, the schedule, remarks.
    virtual void describe(FlowReport& report) const = 0;
};

}  // namespace seamflow
