#pragma once

#include <memory>
#include <vector>

#include "engine/factor_pool.h"
#include "engine/flow_options.h"
#include "engine/flow_report.h"
#include "engine/flow_state.h"
#include "engine/progress.h"
#include "engine/schedule_recorder.h"
#include "engine/task_graph.h"
#include "engine/workspaces.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/trace_equation.h"

namespace seamflow {

/// A mesh flowing by the undecomposed backward Euler steps themselves, taken in pieces, for Laplacians without
/// symmetry, whose rows may reach two rings far: Δ_P. Sub-meshes overlap; what they have to agree about are the
/// positions where each ends within the others. One task graph, run once per step:
///
///     assemble and factorise (each sub-mesh) ──► solve for these traces (see TraceEquation)
///
/// Belongs to the arena in which it is constructed.
class KrylovFlow {
  public:
    /// @param mesh, topology, progress must outlive the flow.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    KrylovFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
               Progress& progress);

    /// One step. After an exception there are no positions, and the flow is at its end.
    /// @param before #V by 3: Vᵏ, what positions() were, in memory of its own.
    /// @throws ComputationError naming the sub-mesh.
    void step(const Points& before);

    /// #V by 3, after the last step.
    [[nodiscard]] const Points& positions() const { return positions_; }

    /// There are no gaps to keep.
    [[nodiscard]] static const PolygonMesh* pieces() { return nullptr; }

    /// Gives what the next step needs, and takes it back, before any step: the flow then goes on from there.
    /// @throws InputError if it does not fit.
    void save(StepMemory& memory) const;
    void restore(const StepMemory& memory);

    /// Adds the seconds spent in tasks.
    void add_seconds(PhaseSeconds& seconds) const;

    /// Fills in what the flow knows of its last step.
    void describe(StepReport& report) const;

    /// Fills in what the flow knows of itself.
    void describe(FlowReport& report) const;

  private:
    void cut_out(const Topology& topology, const Cut& cut);
    void make_blocks(const FlowOptions& options);
    void make_graph();
    void assemble_and_factorise(Index s);
    void solve_traces();

    const PolygonMesh* mesh_;
    Progress* progress_;
    FactorPool factors_;
    Workspaces workspaces_;
    std::vector<GrownPart> parts_;
    std::vector<std::unique_ptr<SchwarzBlock>> blocks_;
    std::vector<SchwarzBlock*> block_views_;
    std::unique_ptr<TraceEquation> equation_;
    /// Of the equation on traces.
    LoopCount loops_;
    TraceStop stop_;
    TraceResult result_;
    /// Estimated, to the undecomposed flow (see ConvergedFlow).
    double distance_ = 0.0;
    double time_step_;
    Index n_interface_vertices_ = 0;
    /// #V by 3: Vᵏ, during a step.
    const Points* before_ = nullptr;
    /// #V by 3: Vᵏ⁺¹, complete at the end of a step.
    Points positions_;
    /// Per sub-mesh.
    std::vector<PhaseSeconds> seconds_;
    double trace_seconds_ = 0.0;
    /// Where the tolerance was missed.
    int steps_short_of_tolerance_ = 0;
    /// Where more iterations would not have helped.
    int steps_stagnated_ = 0;
    /// nullptr: the schedule is not recorded.
    std::unique_ptr<ScheduleRecorder> recorder_;
    TaskGraph graph_;
    TaskGraph::Node root_ = -1;
};

}  // namespace seamflow
