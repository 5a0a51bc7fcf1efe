#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/motion/surface_stepper.h"
#include "engine/options/flow_options.h"
#include "engine/state/step_memory.h"
#include "engine/tasks/progress.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/laplacian/given_stiffness.h"

namespace seamflow {

/// The kind of steps for other data that follow: Further steps; or Again, the same steps as since the last data with
/// Further steps. Steps that are taken again are counted once.
enum class DataSteps { Further, Again };

/// Takes the steps of a flow: each from Vᵏ to Vᵏ⁺¹ with (M + dt K) Vᵏ⁺¹ = M Vᵏ. Each subclass is a way of taking steps
/// (see make_stepper).
class Stepper : public SurfaceStepper {
  public:
    /// The sub-meshes after the last step (see FlowReport::separated); null for sub-meshes without copies of Γ of their
    /// own, and without ReportOptions::keep_gaps.
    [[nodiscard]] virtual const PolygonMesh* separated() const { return nullptr; }

    /// Continues from other data than positions, which is possible for flows with one matrix for all steps: positions()
    /// are then the data. Data on updates and errors are dropped.
    /// @param data #V by 3.
    virtual void set_data(const Points& data, DataSteps) { set_positions(data, {}); }

    /// Whether take_steps can be called, after steps with the first columns.
    [[nodiscard]] virtual bool can_take_columns() const { return false; }

    /// Takes n steps with many columns of other data at once; positions() do not change. Only if can_take_columns() is
    /// true.
    /// @param fields #V by any number of columns.
    virtual void take_steps([[maybe_unused]] Eigen::Ref<Eigen::MatrixXd> fields, [[maybe_unused]] int n,
                            const Executor&)
    {
    }

    /// Moves some vertices, with all their copies, to positions at which the next step begins. Data on updates and
    /// errors are kept.
    /// @param vertices those below 0 are ignored. @param to #vertices by 3.
    virtual void set_vertices(std::span<const Index> vertices, const Points& to) = 0;

    /// Whether the following functions can be called. They recompute only the data that depend on the given vertices.
    [[nodiscard]] virtual bool can_change() const { return false; }

    /// Fixes vertices, or lets them move again.
    virtual void set_fixed(std::span<const Index>, bool) {}

    /// Sets the weight w of some vertices, in 1/length², one for each. Only for flows with an attachment.
    virtual void attach(std::span<const Index>, std::span<const double>) {}

    /// Replaces K and M by given ones, which must outlive the stepper; to be called before the first step. Only for
    /// symmetric Laplacians that are sums over faces, with one matrix for all steps.
    virtual void give(const GivenStiffness&) {}

    /// Multiplies the K of each face, or of each edge for Laplacians that are sums over edges, from now on by 1 / (1 +
    /// d²), where d² is the largest squared_difference(v, w) of two of its vertices: diffusion is reduced where a field
    /// changes fast (Perona and Malik 1990). Only for steppers that can change, with one matrix for all steps.
    virtual void weigh(const std::function<double(Index v, Index w)>&) {}

    /// Moves vertices of V⁰ to other positions (#vertices by 3), as if the flow had begun with them there.
    virtual void set_reference_vertices(std::span<const Index>, const Points&) {}

    /// Per row of each array that `save` writes: the vertex of the mesh to which the row belongs. For steppers that
    /// ranks use.
    [[nodiscard]] virtual std::vector<Index> saved_vertices() const { return {}; }

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
