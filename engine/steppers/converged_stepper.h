#pragma once

#include <span>
#include <vector>

#include "engine/options/flow_options.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/task_graph.h"
#include "engine/tasks/workspaces.h"
#include "solvers/filters/step_filter.h"
#include "solvers/interface/interface_result.h"

namespace seamflow {

/// Common base of steppers that take the undecomposed step itself: an iteration solves an equation to a tolerance, for
/// what sub-meshes share, with tasks of the sub-meshes before it and maybe after it, or for the whole mesh.
class ConvergedStepper : public Stepper {
  public:
    void step(const Points& before) final;
    [[nodiscard]] const Points& positions() const final { return positions_; }
    void set_positions(const Points& image, const SimilarityOfComponents&) final;
    void set_data(const Points& data, DataSteps steps) override;
    void set_vertices(std::span<const Index> vertices, const Points& to) final { move_rows(vertices, to, positions_); }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) final;
    void add_seconds(PhaseSeconds& seconds) const final;
    void report_to(StepReport& report) const final;

  protected:
    /// Adds the equation to the graph.
    /// @param parts_of_equation that it counts for in the progress of a step.
    /// @param progress must outlive the stepper.
    ConvergedStepper(const PolygonMesh& mesh, Index n_sub_meshes, const FlowOptions& options, double parts_of_equation,
                     Progress& progress);

    /// Solves the equation.
    virtual InterfaceResult solve_equation(const IterationStop& stop, const Executor& exec) = 0;

    /// Restores what `save` has added.
    virtual void restore_further(StepMemoryReader&) {}

    /// Fills in what all such steps report.
    void describe_steps(FlowReport& report) const;

    Workspaces workspaces_;
    double time_step_;
    StepFilter filter_;
    /// #V by 3: Vᵏ, during a step.
    const Points* before_ = nullptr;
    /// #V by 3: other data, if any, that the step is applied to with the same factor; 0 where nothing moves.
    const Points* data_ = nullptr;
    /// #V by 3: Vᵏ⁺¹, complete at the end of a step; or the step's result for data.
    Points positions_;
    /// Per sub-mesh, and of the equation.
    std::vector<PhaseSeconds> seconds_;
    TaskGraph graph_;
    TaskGraph::Node root_;
    TaskGraph::Node equation_solved_;

  private:
    /// How a step has missed its tolerance.
    struct Missed {
        bool is_short = false;
        bool has_stagnated = false;
    };

    /// How well steps have kept to their tolerance.
    struct Reached {
        /// In the last step; the residual is relative to that of the positions before it.
        InterfaceResult last;
        /// Estimated distance of the positions to those of the undecomposed flow. The residuals of the steps are added
        /// up like independent errors.
        double distance = 0.0;
        int n_short_of_tolerance = 0;
        int n_stagnated = 0;
        /// How many steps were taken, also before those since `begin`; and for each what is counted of it already.
        int n_taken = 0;
        int first = 0;
        std::vector<Missed> of_step = {};
    };

    void solve();
    void take_filtered();
    void note();

    IterationStop stop_;
    /// Of the iteration.
    LoopCount loops_;
    Reached reached_;
};

}  // namespace seamflow
