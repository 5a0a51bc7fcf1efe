#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/motion/surface_run.h"
#include "engine/setup/prepared_flow.h"
#include "engine/steppers/stepper.h"
#include "engine/steppers/vanishing_components.h"

namespace seamflow {

/// Takes the steps of a prepared flow. If it is asked for, the undecomposed flow takes them, too: the same steps on the
/// whole mesh, without sub-meshes, for comparison.
class FlowRun final : public SurfaceRun {
  public:
    /// Makes the stepper, and that of the undecomposed flow if it is asked for.
    /// @param progress, report must outlive the run; the mesh moves with each step.
    /// @param setup the fraction of the whole flow that setup takes.
    /// @param control with the state to resume from, and ranks that share the steps; must outlive the run.
    /// @throws as make_stepper; InputError for a state that does not fit.
    FlowRun(std::unique_ptr<PreparedFlow> prepared, Progress& progress, double setup, FlowReport& report,
            const FlowControl& control);

    /// The functions of Flow between steps, for vertices of the given mesh. The mesh moves at once.
    /// @throws OptionError if the flow does not allow the change; InputError for vertices that do not exist.
    void set_fixed(std::span<const Index> vertices, bool is_fixed);
    void attach(std::span<const Index> vertices, std::span<const double> weights);
    void move_vertices(std::span<const Index> vertices, const Points& to);

    /// Completes the report, or a copy of it, on the flow as a whole.
    void complete(FlowReport& report) const;

  protected:
    [[nodiscard]] SurfaceStepper& stepper() const override { return *stepper_; }
    void move(const Points& before) override { vanishing_->step(*stepper_, before); }
    void describe(StepReport& of_step) const override;
    [[nodiscard]] std::span<const Index> labels() const override { return flow_report_.cut.labels; }
    void compare(int step, StepReport& of_step) override;
    void show(const StepState& state, const StepObserver& on_step) const override;
    [[nodiscard]] FlowState capture() const override;
    void restore(const FlowState& state) override;

  private:
    [[nodiscard]] const FlowOptions& options() const { return prepared_->options; }
    [[nodiscard]] const FlowPlan& plan() const { return prepared_->plan; }
    void make_steppers();
    void make_stepper_of_flow();
    void require_rows(std::span<const Index> vertices, const Points& to) const;
    [[nodiscard]] std::vector<Index> require_changeable(std::string_view what, std::span<const Index> vertices,
                                                        bool needs_stepper) const;
    void free_topology();

    std::unique_ptr<PreparedFlow> prepared_;
    FlowReport& flow_report_;
    /// The fraction of the whole call that setup takes.
    double setup_;
    std::unique_ptr<Stepper> stepper_;
    /// The stepper of the undecomposed flow, with ReportOptions::reference.
    std::unique_ptr<Stepper> reference_;
    std::optional<VanishingComponents> vanishing_;
    /// Null if one process takes all steps.
    StepSharing* ranks_;
    /// Whether the flow was changed between steps, so that the options no longer describe it.
    bool was_changed_ = false;
    /// #V: 1 for vertices that were fixed between steps.
    std::vector<std::uint8_t> is_fixed_;
    /// #V by 3: the result of the undecomposed flow.
    Points undecomposed_ = Points(0, 3);
};

}  // namespace seamflow
