#pragma once

#include <memory>
#include <vector>

#include "engine/factor_pool.h"
#include "engine/flow_options.h"
#include "engine/flow_report.h"
#include "engine/flow_state.h"
#include "engine/kept_factors.h"
#include "engine/progress.h"
#include "engine/schedule_recorder.h"
#include "engine/task_graph.h"
#include "engine/workspaces.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/interface_equation.h"

namespace seamflow {

/// A mesh flowing by the undecomposed backward Euler steps themselves, taken in pieces, for Δ_F and Δ_A: every sub-mesh
/// eliminates its interior, what remains is an equation on Γ, and then the interiors are filled in. One task graph, run
/// once per step:
///
///     eliminate (each sub-mesh) ──► solve on Γ (see InterfaceEquation) ──► fill in (each sub-mesh)
///
/// Where the memory limit does not let a sub-mesh's factor live from its elimination until it is filled in, it is made
/// again, by the same arithmetic: the bits are the same. Such sub-meshes take turns, as many at a time as there are
/// places.
///
/// Belongs to the arena in which it is constructed.
class ConvergedFlow {
  public:
    /// @param mesh, topology, progress must outlive the flow.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    ConvergedFlow(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
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
    void make_systems(const FlowOptions& options);
    void limit_factors(const FlowOptions& options);
    void make_graph();
    template <class Body>
    TaskGraph::Node add_task(Phase phase, Index s, Body body);
    [[nodiscard]] bool is_kept(Index s) const { return kept_.whole[at(s)] != 0; }
    void take_turns(const std::vector<TaskGraph::Node>& tasks);
    void assemble(Index s, SolverWorkspace& workspace);
    void eliminate(Index s);
    void solve_interface();
    void fill_in(Index s);

    Progress* progress_;
    Decomposition decomposition_;
    Workspaces workspaces_;
    std::vector<std::unique_ptr<NeumannSystem>> systems_;
    std::vector<const NeumannSystem*> system_views_;
    KeptFactors kept_;
    /// Of the factors that are made twice.
    FactorPool passing_factors_;
    InterfaceEquation equation_;
    /// Of the equation on Γ.
    LoopCount loops_;
    InterfaceStop stop_;
    InterfaceResult result_;
    /// Estimated, of the positions to those of the undecomposed flow: what the steps leave adds up like errors that
    /// know nothing of each other.
    double distance_ = 0.0;
    double time_step_;
    /// #V by 3: Vᵏ, during a step.
    const Points* before_ = nullptr;
    /// #V by 3: Vᵏ⁺¹, complete at the end of a step; until it is filled in, what the elimination leaves of the
    /// interior.
    Points positions_;
    /// On Γ: Vᵏ⁺¹ - Vᵏ, and that of the step before, which has no rows in the first step.
    Points interface_;
    Points guess_;
    /// What each sub-mesh has of the right-hand side on Γ.
    Points condensed_;
    /// Per sub-mesh.
    std::vector<PhaseSeconds> seconds_;
    double interface_seconds_ = 0.0;
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
