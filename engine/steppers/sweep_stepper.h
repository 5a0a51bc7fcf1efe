#pragma once

#include <optional>
#include <vector>

#include "engine/memory/shared_factor_pool.h"
#include "engine/memory/workspaces.h"
#include "engine/options/flow_options.h"
#include "engine/options/flow_report.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/error_estimate.h"
#include "engine/steppers/interface_gaps.h"
#include "engine/steppers/stepper.h"
#include "engine/steppers/sub_mesh_state.h"
#include "engine/steppers/sweep_graph.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/step_graph.h"
#include "partition/cut/cut.h"
#include "partition/decomposition/sweep_plan.h"
#include "partition/topology.h"

namespace seamflow {

/// Takes a step in one sweep over the colours of the sub-meshes (see add_sweep), with what InterfaceOptions::conditions
/// says on Γ. The result is near the undecomposed step, not the same.
class SweepStepper final : public Stepper {
  public:
    /// Cuts out the sub-meshes, analyses their equations and builds the graph.
    /// @param mesh, topology, progress must outlive the stepper.
    /// @param curvature #V: ‖ΔV⁰‖; empty: as if it were 0.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    SweepStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                 const std::vector<double>& curvature, Progress& progress);

    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    [[nodiscard]] const PolygonMesh* separated() const override { return copies_ ? copies_->separated() : nullptr; }
    void go_on_from(const Points& image, const Similarity& similarity) override;
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void add_seconds(PhaseSeconds& seconds) const override;
    void describe(StepReport& report) const override;
    void describe(FlowReport& report) const override;

  private:
    void make_states(const PolygonMesh& mesh, const FlowOptions& options, Progress& progress);
    void limit_factors(const FlowOptions& options);
    SweepTasks tasks_of(const SweepPlan& plan, const FlowOptions& options);
    void set_solution(SubMeshState::Solution solution);
    void fetch_positions(SubMeshState& state);
    void join();
    /// Whether sub-meshes differ on what they share: with copies of Γ, and where they overlap.
    [[nodiscard]] bool has_copies() const { return copies_ || !error_; }

    /// Made when it is known what factors take.
    std::optional<SharedFactorPool> factors_;
    Workspaces workspaces_;
    Decomposition decomposition_;
    std::vector<SubMeshState> states_;
    /// Forward, and backward where the sweep alternates.
    std::vector<SweepPlan> plans_;
    FactorWindow window_;
    /// With the classical conditions.
    std::optional<InterfaceGaps> copies_;
    /// But for overlapping sub-meshes.
    std::optional<ErrorEstimate> error_;
    /// A root for each plan.
    StepGraph graph_;
    Points positions_;
    int steps_done_ = 0;
    bool is_low_pass_;
    Factorisation factorisation_;
};

}  // namespace seamflow
