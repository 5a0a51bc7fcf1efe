#pragma once

#include <optional>
#include <span>

#include "engine/measure/displacement_meter.h"
#include "engine/measure/run_report.h"
#include "engine/motion/motion_constraints.h"
#include "engine/motion/step_fractions.h"
#include "engine/motion/surface_stepper.h"
#include "engine/state/flow_state.h"
#include "engine/surface/surface.h"
#include "engine/tasks/progress.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// Takes the steps of a surface, whatever moves it: applies the constraints on its motion, and measures and reports
/// each step. A subclass has the stepper, and what else its kind of steps needs.
class SurfaceRun {
  public:
    SurfaceRun(const SurfaceRun&) = delete;
    SurfaceRun& operator=(const SurfaceRun&) = delete;
    virtual ~SurfaceRun() = default;

    /// Takes one step. The mesh moves when it is complete.
    /// @throws ComputationError naming the step; Cancelled. Afterwards no further step can be taken.
    void take_step(const StepObserver& on_step);

  protected:
    /// @param surface, progress, report must outlive the run; the mesh moves with each step.
    /// @param resume the state to resume from, or null.
    SurfaceRun(Surface& surface, Progress& progress, RunReport& report, const FlowState* resume);

    /// Measures mean curvature and displacements after each step, from now on.
    /// @param meter refers to the topology. @param curvature the largest one now, in 1/length.
    void measure_by(DisplacementMeter meter, const ScaledLaplacian& laplacian, double curvature);

    /// Begins the steps, once there is a stepper.
    /// @param setup the fraction of the whole run that is done. @param steps the number of steps of the whole run.
    /// @param compares whether each step is also taken in another way, and compared (see compare).
    void begin(const MotionOptions& motion, bool continues_scaled, double largest_update, double setup, int steps,
               bool compares = false);

    [[nodiscard]] virtual SurfaceStepper& stepper() const = 0;
    /// Takes the step itself.
    virtual void move(const Points& before) { stepper().step(before); }
    /// Fills in the data on the last step.
    virtual void describe(StepReport&) const {}
    /// #F: the sub-mesh of every face, for messages; empty: there are none.
    [[nodiscard]] virtual std::span<const Index> labels() const { return {}; }
    /// Takes the same step in another way, and compares.
    virtual void compare([[maybe_unused]] int step, StepReport&) {}
    /// Adds to what the observer gets, and calls it.
    virtual void show(const StepState& state, const StepObserver& on_step) const { on_step(state); }

    /// The parts of a state that all runs have. `restore` checks them, and sets the stepper and the mesh accordingly.
    [[nodiscard]] virtual FlowState capture() const;
    virtual void restore(const FlowState& state);
    /// @throws InputError if the positions of a state do not fit the mesh.
    void require_positions(const StepMemory& memory) const;

    /// Adds the remarks of the limits of components and of rescaling, if any step was taken.
    /// @param on_components the remark that takes the place of the remark of the limits if there are no limits (see
    /// ComponentLimits).
    void remark_on_constraints(RunReport& report, const std::optional<Remark>& on_components = {}) const;
    /// Adds the measurements over all steps.
    void report_measures(RunReport& report) const;

    FlowingMesh& mesh_;
    const Topology& topology_;
    Progress& progress_;
    RunReport& report_;
    const FlowState* resume_;
    std::optional<MotionConstraints> constraints_;
    std::optional<StepFractions> fractions_;
    std::optional<DisplacementMeter> meter_;

  private:
    void measure(const Points& after, StepReport& of_step);

    /// The Laplacian with which mean curvature is measured.
    ScaledLaplacian laplacian_;
    /// The largest mean curvature before the next step, in 1/length.
    double curvature_before_ = 0.0;
    /// The size of the surface before the first step (see box_of_faces).
    double extent_before_;
    /// #V by 3: the positions from which the run continues; empty if they are also its results.
    Points of_run_ = Points(0, 3);
    /// #V by 3: the result of the last step, if it differs from of_run_.
    Points result_ = Points(0, 3);
};

}  // namespace seamflow
