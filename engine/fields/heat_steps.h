#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <Eigen/Core>

#include "engine/fields/field_options.h"
#include "engine/measure/flow_report.h"
#include "engine/motion/step_fractions.h"
#include "engine/options/flow_control.h"
#include "engine/options/flow_options.h"
#include "engine/setup/flow_plan.h"
#include "engine/steppers/heat_stepper.h"
#include "engine/surface/surface.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/stopwatch.h"
#include "partition/polygon_mesh.h"
#include "solvers/laplacian/given_stiffness.h"

namespace seamflow {

class SchurStepper;

/// The steps of a HeatEquation: backward Euler steps (M + dt K) Xᵏ⁺¹ = M Xᵏ for columns X of values at the vertices of
/// a surface that does not move. They run on the threads of the arena in which this is constructed.
class HeatSteps {
  public:
    /// Decides how steps are taken, and makes the stepper.
    /// @param surface, control, progress, report must outlive this. The surface does not change.
    /// @param options valid and resolved: time_step is dt, in squared units of length of the surface, whatever gave the
    ///        amount of smoothing (see resolved_options.h).
    /// @throws as HeatEquation.
    HeatSteps(PolygonMesh& surface, const FlowOptions& options, Weights weights, const FlowControl& control,
              Progress& progress, FlowReport& report);

    /// Takes n steps (see HeatEquation::take_steps).
    /// @param fields #V by any number of columns, in the order of the given surface.
    void take(Eigen::Ref<Eigen::MatrixXd> fields, int n);

    /// Multiplies the K of each face from now on by a weight that is small where data change fast (see
    /// SchurStepper::weigh).
    /// @param squared_difference the squared difference of the data at two vertices, without a unit.
    /// @throws OptionError if the steps do not support it.
    void weigh(const std::function<double(Index v, Index w)>& squared_difference);

    /// Completes a copy of the report.
    void complete(FlowReport& report) const;

  private:
    bool flip_edges(Surface& surface);
    void make_surface_and_plan(PolygonMesh& given);
    void make_stepper();
    void make_stepper_within_limit();
    void free_topology();
    void take_block(Points& block, int n, DataSteps steps);
    void take_at_once(Eigen::Ref<Eigen::MatrixXd> fields, int n);
    Stopwatch begin_step();
    void end_steps(const Stopwatch& watch, Eigen::Index n);

    /// The given options. Labels are those of the faces of surface_.
    FlowOptions options_;
    Weights weights_;
    /// Null if one process takes all steps.
    StepSharing* ranks_;
    Progress& progress_;
    FlowReport& report_;
    /// Made in the constructor.
    std::optional<Surface> surface_;
    /// K and M, if the weights of the Laplacian are not those that were asked for; otherwise empty.
    std::optional<GivenStiffness> stiffness_;
    FlowPlan plan_;
    std::optional<StepFractions> fractions_;
    std::unique_ptr<HeatStepper> stepper_;
    /// The same stepper, if it is a SchurStepper; otherwise null.
    SchurStepper* in_sub_meshes_ = nullptr;
};

}  // namespace seamflow
