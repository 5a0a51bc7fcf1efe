#pragma once

#include <memory>
#include <vector>

#include "engine/memory/factor_pool.h"
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
#include "solvers/interface/trace_equation.h"

namespace seamflow {

/// Takes the undecomposed backward Euler step itself, sub-mesh by sub-mesh, for Laplacians without symmetry, whose rows may reach
/// two rings far: Δ_P. Sub-meshes overlap; what they have to agree about are the positions where each ends within the
/// others. One task graph, run once per step:
///
///     assemble and factorise (each sub-mesh) ──► solve for these traces (see TraceEquation)
class SchwarzGmresStepper final : public Stepper {
  public:
    /// @param progress must outlive the stepper.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    SchwarzGmresStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
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
        FactorPool pool;
        Workspaces workspaces;
    };
    /// The sub-meshes.
    struct Parts {
        std::vector<GrownPart> of;
        Index n_interface_vertices = 0;
    };
    /// The equations of the sub-meshes, what the equation on traces sees of them, and that equation.
    struct Blocks {
        std::vector<std::unique_ptr<SchwarzBlock>> of;
        std::vector<SchwarzBlock*> views;
        std::unique_ptr<TraceEquation> equation;
    };

    void cut_out(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const Loop& loop);
    void make_blocks(const FlowOptions& options, Progress& progress);
    void make_graph();
    void assemble_and_factorise(Index s);
    void solve_traces();

    FactorStore factors_;
    Parts parts_;
    Blocks blocks_;
    /// Of the equation on traces.
    LoopCount loops_;
    Convergence convergence_;
    double time_step_;
    Factorisation factorisation_;
    /// #V by 3: Vᵏ, during a step.
    const Points* before_ = nullptr;
    /// #V by 3: Vᵏ⁺¹, complete at the end of a step.
    Points positions_;
    /// Per sub-mesh, and of the equation on traces.
    std::vector<PhaseSeconds> seconds_;
    StepGraph graph_;
};

}  // namespace seamflow
