#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/setup/step_settings.h"
#include "engine/setup/sweep_plan.h"
#include "engine/setup/sweep_steps.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/error_estimate.h"
#include "engine/steppers/interface_gaps.h"
#include "engine/steppers/rank_sub_meshes.h"
#include "engine/steppers/remote_sub_meshes.h"
#include "engine/steppers/shared_factor_pool.h"
#include "engine/steppers/stepper.h"
#include "engine/steppers/sub_mesh_state.h"
#include "engine/steppers/sweep_graph.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/task_graph.h"
#include "engine/tasks/workspaces.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/interface_ranks.h"

namespace seamflow {

/// Sub-meshes, of a whole mesh or of one of several ranks, and their order in a sweep over all.
struct SweepSubMeshes {
    RankSubMeshes own;
    /// #sub-meshes: the turn of each in a sweep forward, from 0 (see SweepPlan::stage).
    std::vector<Index> stage = {};
    /// Only for ranks, for a sweep forward and one backward: this rank's part of orders that are common to all ranks,
    /// and the smallest size with which the sweep cannot deadlock. Empty: the windows follow from the plans.
    std::vector<FactorWindow> windows = {};
    /// Null if all sub-meshes are on this rank; must outlive the stepper.
    RemoteSubMeshes* remote = nullptr;
};

/// Takes a step in one sweep over the colours of the sub-meshes (see add_sweep), with conditions on Γ. The result is
/// near the undecomposed step, but differs from it.
class SweepStepper final : public Stepper {
  public:
    /// Cuts out the sub-meshes, analyses their equations and builds the graph.
    /// @param mesh, topology, progress must outlive the stepper.
    /// @param curvature #V: ‖ΔV⁰‖, in 1/length; empty: as if it were 0.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; MemoryLimitError if the limit is too low;
    ///         Cancelled, as all functions that take time.
    SweepStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const StepSettings& settings,
                 const SweepSteps& sweeps, std::vector<double> curvature, Progress& progress);

    /// Makes the stepper for sub-meshes that have already been cut out, maybe those of one rank.
    /// @param mesh, topology the part of the mesh that the rank knows. @param sweeps for ranks neither with the
    /// classical conditions nor Schwarz's.
    SweepStepper(const PolygonMesh& mesh, const Topology& topology, SweepSubMeshes sub_meshes,
                 const StepSettings& settings, const SweepSteps& sweeps, Progress& progress);

    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    [[nodiscard]] const PolygonMesh* separated() const override { return copies_ ? copies_->separated() : nullptr; }
    void set_positions(const Points& image, const SimilarityOfComponents& similarity) override;
    void set_vertices(std::span<const Index> vertices, const Points& to) override;
    void save(StepMemory& memory) const override;
    /// Per row of each array that `save` writes: the vertex of the mesh to which the row belongs.
    [[nodiscard]] std::vector<Index> saved_vertices() const;
    void restore(const StepMemory& memory) override;
    void add_seconds(PhaseSeconds& seconds) const override;
    void report_to(StepReport& report) const override;
    void report_to(FlowReport& report) const override;

  private:
    void make_states(const PolygonMesh& mesh, const StepSettings& settings, const InterfaceConditions& conditions,
                     Progress& progress);
    [[nodiscard]] bool is_own(Index s) const { return ranks_->is_own(s); }
    void choose_factor_window(std::optional<std::size_t> memory_limit);
    [[nodiscard]] const SweepPlan& plan() const { return plans_[sweep_]; }
    void run_sweep(std::size_t sweep, const std::function<void()>& join = {});
    void perform(TaskKind kind, Index s);
    void perform_own(TaskKind kind, Index s);
    void finish(Index s, SolverWorkspace& workspace);
    Points& rows_of(MessageKind kind, Index s);
    void accept_solution(Index s);
    void take_filtered(std::size_t root, const std::function<void()>& end);
    void begin_solution(SubMeshState::Solution solution);
    void fetch_positions(SubMeshState& state);
    void join();
    /// Whether the positions of a vertex differ between sub-meshes: with copies of Γ, and if sub-meshes overlap, for
    /// which there is no estimate of the error.
    [[nodiscard]] bool has_copies() const { return copies_ || (!error_ && remote_ == nullptr); }

    /// Made once the size of factors is known.
    std::optional<SharedFactorPool> factors_;
    Workspaces workspaces_;
    Decomposition decomposition_;
    std::vector<SubMeshName> names_;
    /// Null if all sub-meshes are on this rank.
    RemoteSubMeshes* remote_ = nullptr;
    std::vector<SubMeshState> states_;
    /// The plan of the sweep forward, and, if the direction alternates, of the sweep backward.
    std::vector<SweepPlan> plans_;
    /// One for each plan, all of the same size.
    std::vector<FactorWindow> windows_;
    /// Only with the classical conditions.
    std::optional<InterfaceGaps> copies_;
    std::unique_ptr<InterfaceRanks> ranks_;
    /// The estimate of the error; empty with overlapping sub-meshes.
    std::optional<ErrorEstimate> error_;
    /// The graph, with a root for each plan.
    TaskGraph graph_;
    Points positions_;
    int steps_done_ = 0;
    /// The number of the plan of the present sweep.
    std::size_t sweep_ = 0;
    double time_step_;
    StepFilter filter_;
    bool corrects_;
};

}  // namespace seamflow
