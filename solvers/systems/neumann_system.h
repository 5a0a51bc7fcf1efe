#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "partition/decomposition/sub_mesh.h"
#include "partition/index_lists.h"
#include "solvers/direct/dense_factor.h"
#include "solvers/direct/factorisation.h"
#include "solvers/direct/ldl_solver.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/laplacian/flow_terms.h"
#include "solvers/laplacian/given_stiffness.h"
#include "solvers/systems/symmetric_matrix.h"

namespace seamflow {

/// A sub-mesh's share A = M + dt K + dt M w of the matrix of the whole backward Euler step, assembled from the
/// sub-mesh's own faces alone: the sum of the shares over all sub-meshes is the whole matrix. With the unknowns on Γ
/// eliminated last, A = L D Lᵀ solves the interior with Γ given, and the last block of the factor is the sub-mesh's
/// Schur complement on Γ. The unknowns are corrections X of Vᵏ⁺¹ - Vᵏ: the residual of X is computed in double
/// precision, a factor may be in single precision. For symmetric Laplacians. One thread at a time.
class NeumannSystem {
  public:
    /// @param sub_mesh without overlap; needed only during the call.
    /// @param faces the sub-mesh's face_vertices. Δ_A (AlexaWardetzky) and Δ_B (VirtualRefinement) keep them, as most
    /// of their data; Δ_F (Fujiwara) and Δ_U (Uniform) keep edges instead.
    /// @param exec runs loops of a mesh without Γ on several threads; empty: everything runs on the calling thread.
    /// @throws ComputationError if the analysis fails.
    NeumannSystem(const SubMesh& sub_mesh, IndexLists faces, const ScaledLaplacian& laplacian,
                  const FlowTerms& terms = {}, const Executor& exec = {});
    NeumannSystem(const NeumannSystem&) = delete;
    NeumannSystem& operator=(const NeumannSystem&) = delete;

    /// A factor, with the right-hand side that condense leaves in it.
    class Factor;

    /// The number of unknowns on Γ.
    [[nodiscard]] Index n_interface() const { return n_interface_; }

    /// The number of unknowns that are not on Γ.
    [[nodiscard]] Index n_interior() const { return static_cast<Index>(unknowns().size()) - n_interface_; }

    /// The own vertices that may move, in the order of the unknowns: the interior, then Γ in its own order.
    [[nodiscard]] const std::vector<Index>& unknowns() const
    {
        return unknown_vertices_.empty() ? matrix_.vertex_of : unknown_vertices_;
    }

    /// Size of a factor, in bytes.
    /// @tparam Number float or double.
    template <class Number>
    [[nodiscard]] std::size_t factor_bytes() const
    {
        return solver_.factor_bytes<Number>();
    }

    /// The equations of a step. They are in the workspace, and valid until the workspace is used again.
    struct Assembled {
        /// The entries of A.
        std::span<const double> matrix;
        /// #local by 3: -dt K Vᵏ - dt M w (Vᵏ - V⁰) - A X at the unknowns.
        const Points& residual;
        /// A power of two near √dt: in this unit of length, corrections fit in single precision.
        double unit = 1.0;
    };

    /// @param positions at least #own by 3: Vᵏ.
    /// @param increments #own by 3: the X found so far.
    /// @param time_step dt, in length².
    /// @param data #own by 3: D, for a step applied to D, A X = M D, without the attachment to V⁰. The residual is then
    ///        M D - A X. Null: the step is applied to Vᵏ.
    [[nodiscard]] Assembled assemble(const Points& positions, const Points& increments, double time_step,
                                     SolverWorkspace& workspace, const Points* data = nullptr) const;

    /// Factorises the matrix of a step.
    /// @param precision Automatic: single precision, if it loses few digits.
    /// @param memory must outlive the factor, as must the system.
    /// @returns nothing where the precision is Automatic, and single precision would lose too many digits.
    /// @throws ComputationError if the equations are singular or not finite.
    [[nodiscard]] std::optional<Factor> factorise(const Assembled& equations, Precision precision, FactorMemory& memory,
                                                  LdlWorkspace& workspace) const;

    /// Takes the Schur complement of the last factorised matrix.
    /// @param factor the last one that `factorise` returned.
    void take_schur_complement(const Factor& factor, const LdlWorkspace& workspace, DenseFactor& complement) const;

    /// Eliminates the interior from the equations.
    /// @param factor stores the eliminated right-hand side for back_substitute.
    /// @param on_interface n_interface() by 3: receives this sub-mesh's share of the right-hand side on Γ.
    void condense(const Assembled& equations, Factor& factor, Eigen::Ref<Points> on_interface) const;

    /// Solves for the correction of the interior, with the correction on Γ given.
    /// @param factor as condense left it.
    /// @param on_interface n_interface() by 3: the correction on Γ.
    /// @param increments #own by 3: the correction is added to the rows of the interior.
    /// @throws ComputationError if the result is not finite.
    void back_substitute(Factor& factor, const Points& on_interface, Points& increments) const;

    /// Whether take_steps can be called: only without Γ, auxiliary unknowns and attachment, and with a factor in double
    /// precision.
    [[nodiscard]] bool can_take_columns(const Factor& factor) const;

    /// Takes some steps of the heat equation for many columns of data at once, faster than column by column, in a flow
    /// that keeps M and K. To be called only where can_take_columns returns true. Fixed vertices keep their values.
    /// @param factor of the matrix of the steps. @param time_step dt, in length².
    /// @param rows per own vertex, its row of `fields`.
    /// @param fields any number of rows by any number of columns: data before, and after the steps.
    /// @throws ComputationError if a result is not finite.
    void take_steps(const Factor& factor, double time_step, int n_steps, std::span<const Index> rows,
                    Eigen::Ref<Eigen::MatrixXd> fields, const Executor& exec) const;

    /// Fixes an own vertex, or lets it move again. The correction of a fixed vertex is 0. To be called for all
    /// sub-meshes that share the vertex.
    void set_fixed(Index v, bool is_fixed);

    /// Sets the weight w of an own vertex, in 1/length². Only for a system with an attachment.
    void attach(Index v, double weight) { matrix_.screening.weights[v] = weight; }

    /// Replaces the kept K and M by given ones (see SymmetricLaplacian::give).
    /// @param local_to_global the numbers of all local vertices in the whole mesh.
    void give(const GivenStiffness& given, std::span<const Index> local_to_global)
    {
        matrix_.laplacian->give(given, local_to_global);
    }

    /// Weighs a kept K (see SymmetricLaplacian::weigh).
    void weigh(const SquaredDifference& squared_difference) { matrix_.laplacian->weigh(squared_difference); }

    /// Replaces V⁰: computes the kept K and M from other positions, and attaches to these.
    /// @param initial at least #own by 3.
    void set_reference(const Points& initial);

  private:
    SparsePattern number_unknowns(const SubMesh& sub_mesh);
    [[nodiscard]] Index n_before_interface() const { return matrix_.n() - n_interface_; }
    void leave_out_fixed(std::span<double> matrix, const Points& increments, Points& residual) const;

    Index n_interface_;
    /// Per own vertex: 1 if it is fixed; empty if none has ever been fixed. And the number of fixed vertices.
    std::vector<std::uint8_t> is_fixed_;
    Index n_fixed_ = 0;
    /// The faces, if the Laplacian needs them in each step.
    IndexLists faces_;
    SymmetricMatrix matrix_;
    /// Per unknown that is not auxiliary: its vertex. Empty if the matrix has no auxiliary unknowns.
    std::vector<Index> unknown_vertices_;
    LdlSolver solver_;
};

class NeumannSystem::Factor {
  public:
    [[nodiscard]] bool is_single() const { return std::holds_alternative<LdlFactor<float>>(numbers_); }

  private:
    friend class NeumannSystem;
    template <class Number>
    Factor(LdlFactor<Number> numbers, double unit)
        : numbers_(std::move(numbers))
        , unit_(unit)
    {
    }

    std::variant<LdlFactor<float>, LdlFactor<double>> numbers_;
    double unit_;
};

}  // namespace seamflow
