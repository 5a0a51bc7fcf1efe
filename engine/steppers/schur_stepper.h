#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/steppers/condensed_sub_mesh.h"
#include "engine/steppers/converged_stepper.h"
#include "engine/steppers/kept_factors.h"
#include "engine/steppers/peer_sub_meshes.h"
#include "engine/steppers/shared_factor_pool.h"
#include "partition/cut/cut.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "solvers/interface/interface_equation.h"
#include "solvers/interface/interface_peers.h"

namespace seamflow {

/// Takes the undecomposed backward Euler step itself, sub-mesh by sub-mesh, for symmetric Laplacians: every sub-mesh
/// condenses its equations to Γ, the equation of the Schur complement is solved there, and back substitution then gives
/// the interiors. One task graph, run once per step:
///
///     condense (each sub-mesh) ──► solve on Γ (see InterfaceEquation) ──► back-substitute (each sub-mesh)
///
/// Factors are in single precision where that loses few digits. The solution on Γ occasionally needs the residual of
/// the whole step there: every sub-mesh then solves for its interior and condenses its residual, computed in double
/// precision. So a step is refined to any tolerance.
///
/// Where the memory limit does not let a sub-mesh's factor live until its back substitution, it is recomputed whenever
/// it is needed, by the same arithmetic: the bits are the same. Such sub-meshes take turns, as many at a time as there
/// are places.
class SchurStepper final : public ConvergedStepper {
  public:
    /// @param progress must outlive the stepper.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; MemoryLimitError if the limit is too low;
    ///         Cancelled, as all functions that take time.
    SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const FlowOptions& options,
                 Progress& progress);

    /// The same for the sub-meshes of one of several peers, which construct their steppers, and take steps, together.
    /// @param mesh the part of the mesh that this peer knows; positions() are Vᵏ⁺¹ only in its own sub-meshes.
    SchurStepper(const PolygonMesh& mesh, PeerSubMeshes sub_meshes, const FlowOptions& options, Progress& progress);

    void set_data(const Points& data, DataSteps steps) override;
    [[nodiscard]] bool can_take_columns() const override;
    void take_steps(Eigen::Ref<Eigen::MatrixXd> fields, int n, const Executor& exec) override;
    [[nodiscard]] bool can_change() const override { return true; }
    void hold(std::span<const Index> vertices, bool is_held) override;
    void attach(std::span<const Index> vertices, std::span<const double> weights) override;
    void give(const GivenStiffness& given) override;
    void weigh(const std::function<double(Index v, Index w)>& squared_difference) override;
    void set_reference_vertices(std::span<const Index> vertices, const Points& to) override;
    void save(StepMemory& memory) const override;
    [[nodiscard]] std::vector<Index> saved_vertices() const override;
    using ConvergedStepper::report_to;
    void report_to(FlowReport& report) const override;

  private:
    /// Where factors live.
    struct FactorStore {
        Precision precision = Precision::Automatic;
        KeptFactors plan;
        /// Memory of the factors that are kept. Under a memory limit they are on the heap instead, because the size of
        /// a factor may differ from step to step.
        SharedFactorPool pool;
        /// Memory of the factors that are recomputed; set once their size is known.
        std::optional<SharedFactorPool> passing;
    };
    /// On Γ.
    struct Interface {
        Index n_vertices = 0;
        std::vector<DenseFactor> complements;
        /// Each sub-mesh's share of the right-hand side, and later of what is left of it.
        Points condensed;
        /// Vᵏ⁺¹ - Vᵏ, if a step has been taken, and that of the step before, if there was one.
        Points update;
        Points guess;
        bool has_update = false;
        /// Whether the complements are also those of the next step.
        bool has_complements = false;
        bool has_guess = false;
        /// The update that interiors and `condensed` belong to.
        Points reached;
    };

    [[nodiscard]] bool is_own(Index s) const { return peers_->is_own(s); }
    [[nodiscard]] bool is_kept(Index s) const { return factors_.plan.whole[s] != 0; }
    void make_sub_meshes(Decomposition& decomposition, const PolygonMesh& mesh, const FlowOptions& options,
                         Progress& progress);
    void choose_factors(const FlowOptions& options);
    void make_graph();
    void take_turns(const std::vector<TaskGraph::Node>& tasks);
    template <class Action>
    void for_each_sub_mesh(const Executor& exec, Action&& action);
    CondensedStep shared_step();
    template <class Action>
    void change(std::span<const Index> vertices, Action&& action);
    /// Whether the matrix is that of the last solution, with its factors.
    [[nodiscard]] bool has_matrix() const { return data_ != nullptr || (interface_.has_complements && !has_changed_); }
    [[nodiscard]] bool has_matrix_of(Index s) const
    {
        return data_ != nullptr || (interface_.has_complements && changed_[s] == 0);
    }
    void condense(Index s);
    void back_substitute(Index s);
    Points& refine_all(const Points& update, const Executor& exec);
    [[nodiscard]] bool has_single() const;
    [[nodiscard]] Point interior_residual() const;
    [[nodiscard]] std::array<bool, 3> at_rest(const Executor& exec) const;
    bool refine_interiors(double tolerance, const Point& first, const Executor& exec);
    InterfaceResult solve_on_interface(bool has_matrix, const IterationStop& stop, const Executor& exec);
    InterfaceResult solve_equation(const IterationStop& stop, const Executor& exec) override;
    void restore_further(StepMemoryReader& memory) override;

    std::unique_ptr<InterfacePeers> peers_;
    std::vector<SubMeshName> names_;
    /// Whether all steps have the same matrix.
    bool keeps_matrix_ = false;
    FactorStore factors_;
    /// #V by 3: V⁰, if something of it is kept.
    Points first_ = Points(0, 3);
    /// Sub-meshes whose matrix has changed since the last step, and whether any has.
    std::vector<std::uint8_t> changed_;
    bool has_changed_ = false;
    /// Where vertices are, once that is asked for.
    struct Place {
        Index sub_mesh;
        Index local;
    };
    Lists<Place> places_of_;
    /// Null for foreign sub-meshes, for which nothing is done.
    std::vector<std::unique_ptr<CondensedSubMesh>> sub_meshes_;
    InterfaceEquation equation_;
    Interface interface_;
};

}  // namespace seamflow
