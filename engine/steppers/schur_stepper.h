#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/memory/kept_factors.h"
#include "engine/memory/shared_factor_pool.h"
#include "engine/steppers/converged_stepper.h"
#include "partition/cut/cut.h"
#include "partition/topology.h"
#include "solvers/interface/interface_equation.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

/// Takes the undecomposed backward Euler step itself, sub-mesh by sub-mesh, for Δ_F and Δ_A: every sub-mesh condenses
/// its equations to Γ, what remains is the equation of the Schur complement there, and then back substitution gives the
/// interiors. One task graph, run once per step:
///
///     condense (each sub-mesh) ──► solve on Γ (see InterfaceEquation) ──► back-substitute (each sub-mesh)
///
/// Where the memory limit does not let a sub-mesh's factor live until its back substitution, it is made again, by the
/// same arithmetic: the bits are the same. Such sub-meshes take turns, as many at a time as there are places.
class SchurStepper final : public ConvergedStepper {
  public:
    /// @param progress must outlive the stepper.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; OptionError if the memory limit is too low;
    ///         Cancelled, as all functions that take time.
    SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                 Progress& progress);

    void save(StepMemory& memory) const override;
    using ConvergedStepper::describe;
    void describe(FlowReport& report) const override;

  private:
    /// What steps need of a sub-mesh (see SubMesh).
    struct OwnVertices {
        std::vector<Index> faces;
        Index n_vertices = 0;
        std::vector<Index> local_to_global;
        std::vector<std::uint8_t> owned;
    };
    struct Part {
        OwnVertices sub_mesh;
        std::unique_ptr<NeumannSystem> system;
        /// From condensation to back substitution, where it is kept.
        std::optional<LdlSolver::Factor> factor;
    };
    /// Where factors live.
    struct FactorStore {
        KeptFactors plan;
        SharedFactorPool kept;
        /// Of the factors that are made twice.
        std::optional<SharedFactorPool> passing;
    };
    /// On Γ.
    struct Interface {
        Index n_vertices = 0;
        std::vector<SchurComplement> complements;
        /// What each sub-mesh has of the right-hand side.
        Points condensed;
        /// Vᵏ⁺¹ - Vᵏ, and that of the step before, which has no rows in the first step.
        Points update;
        Points guess;
    };

    SchurStepper(Decomposition decomposition, const PolygonMesh& mesh, const FlowOptions& options, Progress& progress);
    void make_systems(Decomposition& decomposition, const FlowOptions& options, Progress& progress);
    void limit_factors(const FlowOptions& options);
    void make_graph();
    [[nodiscard]] bool is_kept(Index s) const { return factors_.plan.whole[s] != 0; }
    void take_turns(const std::vector<StepGraph::Node>& tasks);
    std::pair<NeumannSystem::Assembled, LdlSolver::Factor> assemble_and_factorise(Index s, SolverWorkspace& workspace);
    void condense(Index s);
    InterfaceResult solve_equation(const IterationStop& stop, const Loop& loop) override;
    void back_substitute(Index s);
    void restore_further(StepMemoryReader& memory) override;

    FactorStore factors_;
    std::vector<Part> parts_;
    InterfaceEquation equation_;
    Interface interface_;
};

}  // namespace seamflow
