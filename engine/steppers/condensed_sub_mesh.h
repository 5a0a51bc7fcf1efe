#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/measure/flow_report.h"
#include "solvers/direct/dense_factor.h"
#include "solvers/direct/factor_memory.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

/// The data of a step condensed to Γ that all sub-meshes share.
struct CondensedStep {
    /// #V by 3: Vᵏ.
    const Points& before;
    /// #V by 3: receives Vᵏ⁺¹. Until then, interiors have the Vᵏ⁺¹ - Vᵏ reached so far there.
    Points& positions;
    /// #V by 3: data other than Vᵏ that the step is applied to; null if it is applied to Vᵏ.
    const Points* data;
    /// dt, in length².
    double time_step;
    /// #vertices of Γ by 3: the update of Γ for which interiors were solved last.
    const Points& reached;
    /// #copies by 3: the right-hand sides on Γ of all sub-meshes, and later their residuals.
    Points& condensed;
};

/// A sub-mesh whose equations are condensed to Γ and solved by back substitution. One thread at a time.
class CondensedSubMesh {
  public:
    /// The data of a SubMesh that steps need.
    struct Vertices {
        std::vector<Index> faces = {};
        Index n_vertices = 0;
        std::vector<Index> local_to_global = {};
        std::vector<std::uint8_t> owned = {};
    };

    /// @param on_interface the vertices of Γ of which the sub-mesh has copies. @param first_copy the number of the
    /// first of these copies (see InterfaceCopies). @param seconds receives the time of the sub-mesh's tasks. Both
    /// references must outlive the object.
    CondensedSubMesh(Vertices vertices, std::unique_ptr<NeumannSystem> system, std::span<const Index> on_interface,
                     Index first_copy, PhaseSeconds& seconds);

    [[nodiscard]] const Vertices& vertices() const { return vertices_; }
    [[nodiscard]] const NeumannSystem& system() const { return *system_; }
    [[nodiscard]] NeumannSystem& system() { return *system_; }

    /// @param memory for factors. @param is_kept whether the factor lives from condensation to back substitution;
    ///        otherwise it is recomputed whenever it is needed, with the same bits.
    void use_memory(FactorMemory& memory, bool is_kept);
    [[nodiscard]] bool is_kept() const { return is_kept_; }

    /// Whether the factor of this step is in single precision.
    [[nodiscard]] bool is_single() const { return precision_ == Precision::Single; }

    /// The largest residual of the interior in each column at the last condensation.
    [[nodiscard]] const Point& residual() const { return residual_; }

    /// Assembles and factorises the equations, and condenses them to Γ, beginning at Vᵏ⁺¹ = Vᵏ.
    /// @param complement receives the Schur complement.
    void condense(const CondensedStep& step, Precision precision, SolverWorkspace& workspace, DenseFactor& complement);

    /// Condenses the equations again, for other data or another Vᵏ, with the factor of the same matrix; without a kept
    /// factor it factorises anew.
    void condense_again(const CondensedStep& step, SolverWorkspace& workspace);

    /// Solves for the interior at an update of Γ, and condenses the residual of the equations.
    void refine(const CondensedStep& step, const Points& update, SolverWorkspace& workspace);

    /// Completes Vᵏ⁺¹, or the step's result for other data, at the vertices that the sub-mesh owns.
    /// @param keeps_factor whether another solution follows.
    void back_substitute(const CondensedStep& step, const Points& update, bool keeps_factor,
                         SolverWorkspace& workspace);

    /// Whether take_steps can be called: the sub-mesh has a factor from its last step, and
    /// NeumannSystem::can_take_columns returns true for it.
    [[nodiscard]] bool can_take_columns() const;
    /// Takes steps of the heat equation for many columns of data at once (see NeumannSystem::take_steps). Only if
    /// can_take_columns() is true.
    /// @param time_step dt, in length². @param n the number of steps. @param fields #V by any number of columns: the
    /// data before the steps, and then after them.
    void take_steps(double time_step, int n, Eigen::Ref<Eigen::MatrixXd> fields, const Executor& exec) const;

  private:
    /// The local indices of the unknowns that are not on Γ: they come first among the unknowns.
    [[nodiscard]] std::span<const Index> interior() const
    {
        return std::span(system_->unknowns()).first(static_cast<std::size_t>(system_->n_interior()));
    }
    [[nodiscard]] Index global(Index v) const { return vertices_.local_to_global[v]; }
    void begin_increments(const CondensedStep& step, SolverWorkspace& workspace) const;
    void fetch_increments(const CondensedStep& step, SolverWorkspace& workspace) const;
    NeumannSystem::Assembled assemble(const CondensedStep& step, SolverWorkspace& workspace) const;
    NeumannSystem::Factor factorise(const CondensedStep& step, SolverWorkspace& workspace);
    NeumannSystem::Factor take_factor(const CondensedStep& step, SolverWorkspace& workspace);
    void eliminate(const CondensedStep& step, const NeumannSystem::Assembled& equations, NeumannSystem::Factor& factor);
    void substitute(const CondensedStep& step, NeumannSystem::Factor& factor, const Points& update,
                    SolverWorkspace& workspace) const;

    Vertices vertices_;
    std::unique_ptr<NeumannSystem> system_;
    std::span<const Index> on_interface_;
    Index first_copy_;
    PhaseSeconds* seconds_;
    FactorMemory* memory_ = nullptr;
    bool is_kept_ = true;
    /// The precision of the factor in this step; Automatic until it is known.
    Precision precision_ = Precision::Automatic;
    std::optional<NeumannSystem::Factor> factor_;
    Point residual_ = Point::Zero();
};

}  // namespace seamflow
