#pragma once

#include <memory>
#include <vector>

#include "engine/memory/factor_pool.h"
#include "engine/memory/kept_factors.h"
#include "engine/memory/workspaces.h"
#include "engine/options/flow_options.h"
#include "engine/options/flow_report.h"
#include "engine/state/flow_state.h"
#include "engine/steppers/convergence.h"
#include "engine/steppers/stepper.h"
#include "engine/tasks/progress.h"
#include "engine/tasks/step_graph.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/interface_equation.h"

namespace seamflow {

/// Takes the undecomposed backward Euler step itself, sub-mesh by sub-mesh, for Δ_F and Δ_A: every sub-mesh eliminates its
/// interior, what remains is the equation of the Schur complement on Γ, and then the interiors are filled in. One task
/// graph, run once per step:
///
///     eliminate (each sub-mesh) ──► solve on Γ (see InterfaceEquation) ──► fill in (each sub-mesh)
///
/// Where the memory limit does not let a sub-mesh's factor live from its elimination until it is filled in, it is made
/// again, by the same arithmetic: the bits are the same. Such sub-meshes take turns, as many at a time as there are
/// places.
class SchurStepper final : public Stepper {
  public:
    /// @param mesh, topology, progress must outlive the stepper.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                 Progress& progress);

    void step(const Points& before) override;
    [[nodiscard]] const Points& positions() const override { return positions_; }
    void save(StepMemory& memory) const override;
    void restore(const StepMemory& memory) override;
    void add_seconds(PhaseSeconds& seconds) const override;
    void describe(StepReport& report) const override;
    void describe(FlowReport& report) const override;

  private:
    /// Where factors live.
    struct FactorStore {
        Workspaces workspaces;
        KeptFactors kept;
        /// Of the factors that are made twice.
        FactorPool passing;
    };
    /// The equations of the sub-meshes, and what the equation on Γ sees of them.
    struct Systems {
        std::vector<std::unique_ptr<NeumannSystem>> of;
        std::vector<const NeumannSystem*> views;
    };
    /// Vectors on Γ.
    struct Interface {
        /// Vᵏ⁺¹ - Vᵏ, and that of the step before, which has no rows in the first step.
        Points update;
        Points guess;
        /// What each sub-mesh has of the right-hand side.
        Points condensed;
    };

    void make_systems(const FlowOptions& options, Progress& progress);
    void limit_factors(const FlowOptions& options);
    void make_graph();
    [[nodiscard]] bool is_kept(Index s) const { return factors_.kept.whole[s] != 0; }
    void take_turns(const std::vector<StepGraph::Node>& tasks);
    void assemble(Index s, SolverWorkspace& workspace);
    void eliminate(Index s);
    void solve_interface();
    void fill_in(Index s);

    Decomposition decomposition_;
    Systems systems_;
    FactorStore factors_;
    InterfaceEquation equation_;
    /// Of the equation on Γ.
    LoopCount loops_;
    Convergence convergence_;
    double time_step_;
    /// #V by 3: Vᵏ, during a step.
    const Points* before_ = nullptr;
    /// #V by 3: Vᵏ⁺¹, complete at the end of a step; until it is filled in, what the elimination leaves of the
    /// interior.
    Points positions_;
    Interface interface_;
    /// Per sub-mesh, and of the equation on Γ.
    std::vector<PhaseSeconds> seconds_;
    StepGraph graph_;
};

}  // namespace seamflow
