#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/copies_of_interface.h"
#include "engine/drift_estimate.h"
#include "engine/factor_pool.h"
#include "engine/factor_window.h"
#include "engine/flow_options.h"
#include "engine/flow_report.h"
#include "engine/flow_state.h"
#include "engine/progress.h"
#include "engine/schedule_recorder.h"
#include "engine/sub_mesh_state.h"
#include "engine/task_graph.h"
#include "engine/workspaces.h"
#include "partition/cut/cut.h"
#include "partition/decomposition/sweep_plan.h"
#include "partition/topology.h"

namespace seamflow {

/// A mesh flowing in pieces: one task graph, built once, run once per step. Per sub-mesh it has three tasks:
///
///     assemble and factorise ──► solve ──► correct
///                                  ▲         ▲
///        solve of the adjacent ────┘         └──── solve of all
///        sub-meshes that lead                      adjacent sub-meshes
///        it on Γ
///
/// With Transmission::Predicted a fourth, predict, stands between the first two of each sub-mesh, and solve also waits
/// for the predictions of the sub-meshes that it leads. With the classical conditions nobody leads, and solve waits for
/// those of lower colour. So that few factors live at once, assemble and factorise also waits for a solve some places
/// before in a fixed order (see FactorWindow). No barrier stands between colours. Belongs to the arena in
/// which it is constructed.
class DecomposedFlow {
  public:
    /// Cuts out the sub-meshes, analyses their equations and builds the graph.
    /// @param mesh, topology must outlive the flow.
    /// @param curvature #V: ‖ΔV⁰‖.
    /// @param progress must outlive the flow; counts sub-meshes here, and tasks in steps.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    DecomposedFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                   const std::vector<double>& curvature, Progress& progress);

    /// One backward Euler step. After an exception the flow is at its end.
    /// @param before #V by 3: Vᵏ, which is positions(), or what they were, in memory of its own.
    /// @throws ComputationError naming the sub-mesh.
    void step(const Points& before);

    /// #V by 3, after the last step.
    [[nodiscard]] const Points& positions() const { return positions_; }

    /// The sub-meshes after the last complete step (see FlowReport::pieces); null without FlowOptions::keep_gaps.
    [[nodiscard]] const PolygonMesh* pieces() const { return copies_ ? copies_->pieces() : nullptr; }

    /// Gives what the next step needs, and takes it back, before any step: the flow then goes on from there.
    /// @throws InputError if it does not fit.
    void save(StepMemory& memory) const;
    void restore(const StepMemory& memory);

    /// Adds the seconds spent in tasks.
    void add_seconds(PhaseSeconds& seconds) const;

    /// Fills in what the flow knows of its last step.
    void describe(StepReport& report) const;

    /// Fills in what the flow knows of itself: sub-meshes, colours, p, seconds spent in tasks, the schedule.
    void describe(FlowReport& report) const;

  private:
    void make_states(const PolygonMesh& mesh, const FlowOptions& options, Progress& progress);
    TaskGraph::Node add_sweep(const SweepPlan& plan, const FlowOptions& options);
    void add_predictions(const SweepPlan& plan, const std::vector<TaskGraph::Node>& factorised,
                         const std::vector<TaskGraph::Node>& solved);
    void limit_factors(const FlowOptions& options);
    void add_window(const std::vector<TaskGraph::Node>& factorised, const std::vector<TaskGraph::Node>& solved);
    void add_traces(const SweepPlan& plan, const std::vector<TaskGraph::Node>& solved);
    template <class Body>
    TaskGraph::Node add_task(Phase phase, Index s, Body body, TaskGraph::Priority priority);
    void join();

    FactorPool factors_;
    Workspaces workspaces_;
    Decomposition decomposition_;
    std::vector<SubMeshState> states_;
    /// Forward, and backward where the sweep alternates.
    std::vector<SweepPlan> plans_;
    FactorWindow window_;
    std::vector<TaskGraph::Node> roots_;
    /// With the classical conditions.
    std::optional<CopiesOfInterface> copies_;
    /// But for overlapping sub-meshes.
    std::optional<DriftEstimate> drift_;
    /// nullptr: the schedule is not recorded.
    std::unique_ptr<ScheduleRecorder> recorder_;
    TaskGraph graph_;
    Points positions_;
    int steps_done_ = 0;
    /// Whether sub-meshes differ on what they share.
    bool has_copies_;
};

}  // namespace seamflow
