#pragma once

#include <span>
#include <vector>

#include "engine/setup/step_settings.h"
#include "engine/steppers/heat_stepper.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/task_graph.h"
#include "engine/tasks/workspaces.h"
#include "solvers/filters/step_filter.h"
#include "solvers/interface/interface_result.h"

namespace seamflow {

/// Common base of steppers that take the undecomposed step itself. Each step solves an equation to a tolerance by an
/// iteration: an equation for the vertices that sub-meshes share, with tasks of the sub-meshes before it and perhaps
/// after it; or an equation for the whole mesh.
class ConvergedStepper : public HeatStepper {
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
    /// Adds the solution of the equation to the graph as a task.
    /// @param stop ends the iterations of each solution.
    /// @param parts_of_equation the share of this task in the progress of a step; that of a sub-mesh's task is 1.
    /// @param progress must outlive the stepper.
    ConvergedStepper(const PolygonMesh& mesh, Index n_sub_meshes, const StepSettings& settings,
                     const IterationStop& stop, double parts_of_equation, Progress& progress);

    /// Solves the equation.
    virtual InterfaceResult solve_equation(const IterationStop& stop, const Executor& exec) = 0;

    /// Restores the data that `save` of a subclass has added.
    virtual void restore_further(StepMemoryReader&) {}

    /// Fills in the part of the report that is common to all such steppers.
    void describe_steps(FlowReport& report) const;

    Workspaces workspaces_;
    double time_step_;
    StepFilter filter_;
    /// #V by 3: Vᵏ, during a step.
    const Points* before_ = nullptr;
    /// #V by 3: other data that the step is applied to, with the same factor; 0 where nothing moves. Null: the step is
    /// applied to Vᵏ.
    const Points* data_ = nullptr;
    /// #V by 3: Vᵏ⁺¹, complete at the end of a step; or the result of the step for data_.
    Points positions_;
    /// Per sub-mesh, and for the equation: the times of tasks.
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

    /// The accuracy of the steps so far.
    struct Reached {
        /// The last step; its residual is relative to that of the positions before it.
        InterfaceResult last;
        /// The estimated distance of the positions to those of the undecomposed flow. The estimates of the steps are
        /// added up like independent errors: as squares.
        double distance = 0.0;
        int n_short_of_tolerance = 0;
        int n_stagnated = 0;
        /// The number of steps taken, without repetitions (DataSteps::Again).
        int n_taken = 0;
        /// The value of n_taken when steps were last declared DataSteps::Further: repetitions start from it.
        int n_before_data = 0;
        /// Per step: how it, or a repetition of it, has missed the tolerance.
        std::vector<Missed> of_step = {};
    };

    void solve();
    void take_filtered();
    void count_missed();

    IterationStop stop_;
    /// Counts the loops of the iteration.
    LoopCount loops_;
    Reached reached_;
};

}  // namespace seamflow
