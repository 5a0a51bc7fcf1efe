#pragma once

#include <memory>

#include "engine/measure/flow_report.h"
#include "engine/setup/flowing_mesh.h"
#include "engine/setup/prepared_flow.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"

namespace seamflow {

/// Takes the steps of a prepared flow, measures each, and reports it.
class FlowRun {
  public:
    /// Makes the stepper, and that of the undecomposed flow if it is asked for.
    /// @param mesh, progress, report must outlive the run; the mesh moves with each step.
    /// @param setup the fraction of the whole call that setup takes.
    /// @throws as make_stepper.
    FlowRun(FlowingMesh& mesh, std::unique_ptr<PreparedFlow> prepared, Progress& progress, double setup,
            FlowReport& report);

    /// Takes all steps. The mesh moves after each complete step, including the undecomposed one.
    /// @param resume the state to resume from; nullptr: from the beginning.
    /// @throws ComputationError naming the step; InputError for a state that does not fit; Cancelled.
    void take_steps(const StepObserver& on_step, const FlowState* resume);

  private:
    class StepFractions;
    struct StepTools;

    [[nodiscard]] const FlowOptions& options() const { return prepared_->options; }
    void restore(const FlowState& state, StepTools& tools);
    [[nodiscard]] FlowState capture(const FlowState* resume) const;
    void compare_with_reference(int step, StepTools& tools, const StepFractions& fractions, StepReport& of_step);
    void measure(const Points& after, StepReport& of_step);
    void tell(const StepObserver& on_step, int step, const StepReport& of_step, const Points* undecomposed,
              const FlowState* resume) const;
    void finish(double extent_before, const FlowState* resume);

    FlowingMesh& mesh_;
    std::unique_ptr<PreparedFlow> prepared_;
    Progress& progress_;
    FlowReport& report_;
    /// The fraction of the whole call before the first step.
    double setup_;
    double curvature_before_;
    std::unique_ptr<Stepper> stepper_;
    /// Of the undecomposed flow, with ReportOptions::reference.
    std::unique_ptr<Stepper> reference_;
};

}  // namespace seamflow
