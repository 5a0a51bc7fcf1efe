#pragma once

#include <span>

#include "engine/measure/flow_report.h"
#include "engine/motion/surface_stepper.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Changes the equations of a stepper between two of its steps. Only data that depend on the given vertices are
/// recomputed.
class ChangeableEquations {
  public:
    /// Fixes vertices, or lets them move again.
    virtual void set_fixed(std::span<const Index> vertices, bool is_fixed) = 0;

    /// Sets the weight w of some vertices, in 1/length², one for each. Only for flows with an attachment.
    virtual void attach(std::span<const Index> vertices, std::span<const double> weights) = 0;

    /// Moves vertices of V⁰ to other positions, as if the flow had begun with them there.
    /// @param to #vertices by 3.
    virtual void set_reference_vertices(std::span<const Index> vertices, const Points& to) = 0;

  protected:
    ~ChangeableEquations() = default;
};

/// Takes the steps of a flow: each from Vᵏ to Vᵏ⁺¹ with (M + dt K) Vᵏ⁺¹ = M Vᵏ. Each subclass is a way of taking steps
/// (see make_stepper).
class Stepper : public SurfaceStepper {
  public:
    /// The sub-meshes after the last step (see FlowReport::separated); null for sub-meshes without copies of Γ of their
    /// own, and without ReportOptions::keep_gaps.
    [[nodiscard]] virtual const PolygonMesh* separated() const { return nullptr; }

    /// Moves some vertices, with all their copies, to positions at which the next step begins. What the stepper keeps
    /// of earlier steps besides positions stays: their updates, and its estimate of the error.
    /// @param vertices numbers below 0 are ignored. @param to #vertices by 3.
    virtual void set_vertices(std::span<const Index> vertices, const Points& to) = 0;

    /// The equations, if they can be changed between steps; null if they cannot.
    [[nodiscard]] virtual ChangeableEquations* equations() { return nullptr; }

    /// Adds the seconds spent in tasks.
    virtual void add_seconds(PhaseSeconds& seconds) const = 0;

    /// Fills in the data on the last step.
    virtual void report_to(StepReport& report) const = 0;

    /// Fills in the data on all steps: sub-meshes, colours, seconds spent in tasks, the schedule, remarks.
    virtual void report_to(FlowReport& report) const = 0;
};

/// Implements Stepper::set_vertices for positions without copies.
void move_rows(std::span<const Index> vertices, const Points& to, Points& positions);

}  // namespace seamflow
