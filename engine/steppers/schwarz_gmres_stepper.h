#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/steppers/converged_stepper.h"
#include "engine/steppers/shared_factor_pool.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/trace_equation.h"

namespace seamflow {

/// Takes the undecomposed backward Euler step itself, sub-mesh by sub-mesh, for unsymmetric Laplacians, whose rows may
/// reach over two rings: Δ_P. Sub-meshes overlap; they must agree on the positions where each ends within the others.
/// One task graph, run once per step:
///
///     assemble and factorise (each sub-mesh) ──► solve for these traces (see TraceEquation)
class SchwarzGmresStepper final : public ConvergedStepper {
  public:
    /// @param progress must outlive the stepper.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    SchwarzGmresStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                        Progress& progress);

    using ConvergedStepper::describe;
    void describe(FlowReport& report) const override;

  private:
    /// The equations of the sub-meshes.
    struct Blocks {
        std::vector<std::unique_ptr<SchwarzBlock>> of;
        /// Of the present step.
        std::vector<SchwarzBlock::Factor> factors;
    };

    void cut_out(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const Executor& exec);
    void make_blocks(const FlowOptions& options, Progress& progress);
    void limit_factors(const FlowOptions& options);
    void make_graph();
    void assemble_and_factorise(Index s);
    InterfaceResult solve_equation(const IterationStop& stop, const Executor& exec) override;

    std::vector<GrownPart> parts_;
    Index n_interface_vertices_ = 0;
    /// Where factors live; made when their size is known.
    std::optional<SharedFactorPool> memory_;
    Blocks blocks_;
    std::optional<TraceEquation> equation_;
    Factorisation factorisation_;
};

}  // namespace seamflow
