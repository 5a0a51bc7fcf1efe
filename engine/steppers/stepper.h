#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/measure/rescaling.h"
#include "engine/options/flow_options.h"
#include "engine/state/flow_state.h"
#include "engine/tasks/progress.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/laplacian/given_stiffness.h"

namespace seamflow {

/// The steps that follow for other data: further ones, or again those since the last data that had further ones. Steps
/// that are taken again count once.
enum class DataSteps { Further, Again };

/// Takes the steps of a flow, one after the other: each from Vᵏ to Vᵏ⁺¹ with (M + dt K) Vᵏ⁺¹ = M Vᵏ. How it does so is
/// up to the subclass (see make_stepper below for the ways). Belongs to the arena in which it is constructed.
class Stepper {
  public:
    Stepper() = default;
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;
    virtual ~Stepper() = default;

    /// Takes a step. After an exception there are no positions, and the stepper is unusable.
    /// @param before #V by 3: Vᵏ, which is what positions() is or was, in separate memory.
    /// @throws ComputationError naming the sub-mesh; Cancelled.
    virtual void step(const Points& before) = 0;

    /// #V by 3, after the last step.
    [[nodiscard]] virtual const Points& positions() const = 0;

    /// The sub-meshes after the last step (see FlowReport::separated); null where they have no copies of their own of
    /// Γ, and without ReportOptions::keep_gaps.
    [[nodiscard]] virtual const PolygonMesh* separated() const { return nullptr; }

    /// Continues from an image of positions(), and of all positions that the next step needs. positions() are then the
    /// image, up to rounding. What is known of updates and errors stays: a step makes earlier errors smaller by about
    /// as much as its result is scaled back.
    /// @param image #V by 3: positions() mapped by the similarity of each component; vertices without faces stay.
    virtual void set_positions(const Points& image, const SimilarityOfComponents& similarity) = 0;

    /// Continues from other data than positions, as flows with one matrix for all steps can: positions() are then the
    /// data. Nothing is known of updates and errors any more.
    /// @param data #V by 3.
    virtual void set_data(const Points& data, DataSteps) { set_positions(data, {}); }

    /// Whether many columns of other data can take steps at once, after steps with the first ones.
    [[nodiscard]] virtual bool can_take_columns() const { return false; }

    /// Takes n steps with them; positions() stay. Only where that is possible.
    /// @param fields #V by any number of columns.
    virtual void take_steps([[maybe_unused]] Eigen::Ref<Eigen::MatrixXd> fields, [[maybe_unused]] int n,
                            const Executor&)
    {
    }

    /// Moves some vertices, with all copies of them, to where the next step is to find them. What is known of updates
    /// and errors stays.
    /// @param vertices those below 0 are ignored. @param to #vertices by 3.
    virtual void set_vertices(std::span<const Index> vertices, const Points& to) = 0;

    /// Whether the following are possible, which make anew only what depends on the vertices they name.
    [[nodiscard]] virtual bool can_change() const { return false; }

    /// Holds vertices where they are, or lets them move again.
    virtual void hold(std::span<const Index>, bool) {}

    /// Sets w of the attachment of vertices, in 1/length², one for each. Only for flows that attach.
    virtual void attach(std::span<const Index>, std::span<const double>) {}

    /// Takes K and M of other origin, which must outlive the stepper, before the first step. Only for symmetric
    /// Laplacians that are sums over faces, with one matrix for all steps.
    virtual void give(const GivenStiffness&) {}

    /// Weighs the K of all faces, or edges of Laplacians that are sums over these, from now on by 1 / (1 + d²), where
    /// d² is the largest squared_difference(v, w) of two of its vertices: it lessens with differences of a field
    /// (Perona and Malik 1990). Only for steppers that can change, with one matrix for all steps.
    virtual void weigh(const std::function<double(Index v, Index w)>&) {}

    /// Moves vertices in what is kept of V⁰ to other positions (#vertices by 3), as if the flow had begun with them
    /// there.
    virtual void set_reference_vertices(std::span<const Index>, const Points&) {}

    /// Saves what the next step needs.
    virtual void save(StepMemory& memory) const = 0;

    /// Per row of each array that `save` gives, the vertex of the mesh to which the row belongs; for steppers that
    /// ranks use.
    [[nodiscard]] virtual std::vector<Index> saved_vertices() const { return {}; }

    /// Restores what `save` has given, before any step: the next one continues from there.
    /// @throws InputError if it does not fit.
    virtual void restore(const StepMemory& memory) = 0;

    /// Adds the seconds spent in tasks.
    virtual void add_seconds(PhaseSeconds& seconds) const = 0;

    /// Fills in what is known of the last step.
    virtual void report_to(StepReport& report) const = 0;

    /// Fills in what is known of all steps: sub-meshes, colours, seconds spent in tasks, the schedule, remarks.
    virtual void report_to(FlowReport& report) const = 0;
};

/// Stepper::set_vertices for positions that have no copies.
void move_rows(std::span<const Index> vertices, const Points& to, Points& positions);

}  // namespace seamflow
