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
#include "engine/steppers/rank_sub_meshes.h"
#include "engine/steppers/shared_factor_pool.h"
#include "partition/cut/cut.h"
#include "partition/index_lists.h"
#include "partition/topology.h"
#include "solvers/interface/interface_equation.h"
#include "solvers/interface/interface_ranks.h"
#include "solvers/laplacian/given_stiffness.h"

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
/// Where the memory limit does not let a sub-mesh's factor live until its back substitution, the factor is recomputed
/// whenever it is needed, by the same arithmetic: the bits are the same. Such sub-meshes take turns, as many at a time
/// as there are slots (see KeptFactors).
class SchurStepper final : public ConvergedStepper, public ChangeableEquations {
  public:
    /// @param progress must outlive the stepper.
    /// @param given K and M of a linear flow in place of those of the Laplacian, which is a sum over faces; null: none.
    /// @throws ComputationError naming the sub-mesh if an analysis fails; MemoryLimitError if the limit is too low;
    ///         Cancelled, as all functions that take time.
    SchurStepper(const PolygonMesh& mesh, const Topology& topology, const Cut& cut, const StepSettings& settings,
                 const IterationStop& stop, Progress& progress, const GivenStiffness* given = nullptr);

    /// The stepper for the sub-meshes of one of several ranks, which construct their steppers, and take steps,
    /// together.
    /// @param mesh the part of the mesh that this rank knows; positions() are Vᵏ⁺¹ only in its own sub-meshes.
    SchurStepper(const PolygonMesh& mesh, RankSubMeshes sub_meshes, const StepSettings& settings,
                 const IterationStop& stop, Progress& progress, const GivenStiffness* given = nullptr);

    void set_data(const Points& data, DataSteps steps) override;

    /// Whether take_columns can be called: the whole mesh is one sub-mesh, the filter is plain, the last step of a
    /// linear flow has left its factor, no equation has changed since, and NeumannSystem::can_take_columns returns
    /// true.
    [[nodiscard]] bool can_take_columns() const;

    /// Takes n steps with many columns of other data at once; positions() do not change. Only if can_take_columns() is
    /// true.
    /// @param fields #V by any number of columns. @param exec whose threads share the columns.
    void take_columns(Eigen::Ref<Eigen::MatrixXd> fields, int n, const Executor& exec);

    /// Multiplies the K of each face, or of each edge for Laplacians that are sums over edges, from now on by 1 / (1 +
    /// d²), where d² is the largest squared_difference(v, w) of two of its vertices: diffusion is reduced where a field
    /// changes fast (Perona and Malik 1990). Only for linear flows.
    void weigh(const std::function<double(Index v, Index w)>& squared_difference);

    [[nodiscard]] ChangeableEquations* equations() override { return this; }
    void set_fixed(std::span<const Index> vertices, bool is_fixed) override;
    void attach(std::span<const Index> vertices, std::span<const double> weights) override;
    void set_reference_vertices(std::span<const Index> vertices, const Points& to) override;
    void save(StepMemory& memory) const override;

    /// Per row of each array that `save` writes: the vertex of Γ to which the row belongs.
    [[nodiscard]] std::vector<Index> saved_vertices() const;

    using ConvergedStepper::report_to;
    void report_to(FlowReport& report) const override;

  private:
    /// The memory of factors.
    struct FactorStore {
        /// The precision that was asked for.
        Precision precision = Precision::Automatic;
        /// Which factors are kept: `whole` has an entry for each sub-mesh, 1 for remote ones.
        KeptFactors plan;
        /// Memory of the kept factors. Under a memory limit factors are on the heap instead, because the size of a
        /// factor may differ from step to step.
        SharedFactorPool pool;
        /// Memory of the recomputed factors; set once their size is known.
        std::optional<SharedFactorPool> recomputed;
    };
    /// The data on Γ.
    struct Interface {
        Index n_vertices = 0;
        /// Per sub-mesh: its Schur complement S, as `condense` left it.
        std::vector<DenseFactor> complements;
        /// #copies by 3: each sub-mesh's share of the right-hand side, and later of the residual.
        Points condensed;
        /// #Γ by 3: Vᵏ⁺¹ - Vᵏ of the last step, if a step has been taken; and of the step before it, if there was one,
        /// as the first guess of the iteration.
        Points update;
        Points guess;
        bool has_update = false;
        /// Whether the complements are also those of the next step, which has the same matrix.
        bool has_complements = false;
        /// Whether `guess` is the update of an earlier step.
        bool has_guess = false;
        /// #Γ by 3: the update for which interiors and `condensed` were computed.
        Points reached;
    };

    [[nodiscard]] bool is_own(Index s) const { return ranks_->is_own(s); }
    [[nodiscard]] bool is_kept(Index s) const { return factors_.plan.whole[s] != 0; }
    void make_sub_meshes(Decomposition& decomposition, const StepEquation& equation, const GivenStiffness* given,
                         Progress& progress);
    void choose_factors(const FactorSettings& settings);
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

    std::unique_ptr<InterfaceRanks> ranks_;
    std::vector<SubMeshName> names_;
    /// Whether all steps have the same matrix.
    bool keeps_matrix_ = false;
    FactorStore factors_;
    /// #V by 3: V⁰, if K or M of V⁰ is kept.
    Points initial_ = Points(0, 3);
    /// Per sub-mesh: 1 if its matrix has changed since the last step; and whether any has.
    std::vector<std::uint8_t> changed_;
    bool has_changed_ = false;
    /// A vertex in a sub-mesh.
    struct LocalVertex {
        Index sub_mesh;
        Index local;
    };
    /// Per vertex of the mesh: its local vertices in own sub-meshes; empty until `change` needs them.
    Lists<LocalVertex> local_vertices_of_;
    /// Null for remote sub-meshes, for which this rank computes nothing.
    std::vector<std::unique_ptr<CondensedSubMesh>> sub_meshes_;
    InterfaceEquation equation_;
    Interface interface_;
};

}  // namespace seamflow
