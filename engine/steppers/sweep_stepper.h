#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/measure/flow_report.h"
#include "engine/setup/step_settings.h"
#include "engine/setup/sweep_steps.h"
#include "engine/state/step_memory.h"
#include "engine/steppers/error_estimate.h"
#include "engine/steppers/shared_factor_pool.h"
#include "engine/steppers/stepper.h"
#include "engine/sweep/factor_windows.h"
#include "engine/sweep/remote_sub_meshes.h"
#include "engine/sweep/sub_mesh_sweep.h"
#include "engine/sweep/sweep_graph.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/task_graph.h"
#include "engine/tasks/workspaces.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/interface_ranks.h"

namespace seamflow {

/// What a SweepStepper knows of ranks. With one rank only `ranks` is set.
struct RanksOfSweep {
    /// The ranks that estimate the error together.
    std::unique_ptr<InterfaceRanks> ranks;
    /// For a sweep forward and one backward: this rank's part of orders that are common to all ranks, and the smallest
    /// size with which the sweep cannot deadlock. Empty: the windows follow from the plans.
    std::vector<FactorWindow> windows = {};
    /// Null if all sub-meshes are on this rank; must outlive the stepper.
    RemoteSubMeshes* remote = nullptr;
};

/// Takes a step in one sweep over the colours of the sub-meshes (see SubMeshSweep), with conditions on Γ. The result is
/// near the undecomposed step, but differs from it. The tasks run in a graph (see add_sweep).
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
    /// @param mesh, topology the part of the mesh that the rank knows. @param sweeps for ranks with
    /// predictions or adapted conditions.
    SweepStepper(const PolygonMesh& mesh, const Topology& topology, SweepSubMeshes sub_meshes, RanksOfSweep ranks,
                 const StepSettings& settings, const SweepSteps& sweeps, Progress& progress);

    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return sweep_.positions(); }
    [[nodiscard]] const PolygonMesh* separated() const override;
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
    void perform(TaskKind kind, Index s);
    void perform_own(TaskKind kind, Index s);
    void finish(Index s, SolverWorkspace& workspace);
    void accept(Index s);
    Points& rows_of(MessageKind kind, Index s);
    void run_sweep(const std::function<void()>& join = {});
    void take_filtered(const std::function<void()>& end);
    /// Whether the positions of a vertex differ between sub-meshes: with copies of Γ, and if sub-meshes overlap, for
    /// which there is no estimate of the error.
    [[nodiscard]] bool has_copies() const { return sweep_.gaps() != nullptr || !error_; }

    Workspaces workspaces_;
    /// Made once the size of factors is known.
    std::optional<SharedFactorPool> factors_;
    SubMeshSweep sweep_;
    RanksOfSweep ranks_;
    /// #sub-meshes: the times of their tasks in all steps.
    std::vector<PhaseSeconds> seconds_;
    /// The estimate of the error; empty with overlapping sub-meshes.
    std::optional<ErrorEstimate> error_;
    /// The graph, with a root for each plan.
    TaskGraph graph_;
    StepFilter filter_;
    int steps_done_ = 0;
};

}  // namespace seamflow
