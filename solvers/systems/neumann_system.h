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

/// A sub-mesh's share A = M + dt K + dt M w of the whole backward Euler system, assembled from its own faces alone:
/// summed over the sub-meshes, the shares are the whole. Factorised with Γ last, A = L D Lᵀ solves the interior with Γ
/// given, and its last block is the sub-mesh's Schur complement on Γ. The unknowns are corrections X of Vᵏ⁺¹ - Vᵏ: the
/// residual of X is computed in double precision, a factor may be in single precision. For symmetric Laplacians. One
/// thread at a time.
class NeumannSystem {
  public:
    /// @param sub_mesh without overlap; needed only during the call.
    /// @param faces its face_vertices: most of the data that Δ_A and Δ_B keep; Δ_F keeps edges.
    /// @param exec runs what several threads can do at once, of a mesh without Γ; empty: nothing is.
    /// @throws ComputationError if the analysis fails.
    NeumannSystem(const SubMesh& sub_mesh, IndexLists faces, const ScaledLaplacian& laplacian,
                  const FlowTerms& terms = {}, const Executor& exec = {});
    NeumannSystem(const NeumannSystem&) = delete;
    NeumannSystem& operator=(const NeumannSystem&) = delete;

    /// A factor, and the state of the right-hand side in it.
    class Factor;

    /// Number of vertices on Γ.
    [[nodiscard]] Index n_interface() const { return n_interface_; }

    /// Number of the other vertices that may move.
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

    /// The equations of a step, in a workspace: valid until that is used again.
    struct Assembled {
        /// A.
        std::span<const double> matrix;
        /// #local by 3: -dt K Vᵏ - dt M w (Vᵏ - V⁰) - A X at the unknowns.
        const Points& residual;
        /// A power of two near √dt: in this unit of length, corrections fit in single precision.
        double unit = 1.0;
    };

    /// @param positions at least #own by 3: Vᵏ.
    /// @param increments #own by 3: X, so far.
    /// @param time_step dt, in length².
    /// @param data #own by 3: D, if the step is to be applied to that, A X = M D, without the attachment to V⁰. The
    ///        residual is M D - A X then.
    [[nodiscard]] Assembled assemble(const Points& positions, const Points& increments, double time_step,
                                     SolverWorkspace& workspace, const Points* data = nullptr) const;

    /// @param precision Automatic: single precision.
    /// @param memory must outlive the factor, as must the system.
    /// @returns nothing where the precision is Automatic, and single precision would lose too many digits.
    /// @throws ComputationError if the equations are singular or not finite.
    [[nodiscard]] std::optional<Factor> factorise(const Assembled& equations, Precision precision, FactorMemory& memory,
                                                  LdlWorkspace& workspace) const;

    /// Takes the Schur complement of the last factorised matrix.
    /// @param factor of that matrix.
    void take_schur_complement(const Factor& factor, const LdlWorkspace& workspace, DenseFactor& complement) const;

    /// Eliminates the interior from the equations.
    /// @param factor keeps data for back_substitute.
    /// @param on_interface n_interface() by 3: receives this sub-mesh's share of the right-hand side on Γ.
    void condense(const Assembled& equations, Factor& factor, Eigen::Ref<Points> on_interface) const;

    /// Solves for the correction of the interior, with that of Γ given.
    /// @param factor as condense left it.
    /// @param on_interface n_interface() by 3.
    /// @param increments #own by 3: the correction is added in the interior.
    /// @throws ComputationError if the result is not finite.
    void back_substitute(Factor& factor, const Points& on_interface, Points& increments) const;

    /// Whether many columns of data can take steps at once: without Γ, auxiliary unknowns and attachment, with a factor
    /// in double precision.
    [[nodiscard]] bool can_take_columns(const Factor& factor) const;

    /// Takes some steps of the heat equation with many columns of data, faster than column by column, in a flow that
    /// keeps M and K. Only where that is possible. Held vertices keep their values.
    /// @param factor of the steps. @param rows per own vertex, its row of the fields.
    /// @throws ComputationError if a result is not finite.
    void take_steps(const Factor& factor, double time_step, int n_steps, std::span<const Index> rows,
                    Eigen::Ref<Eigen::MatrixXd> fields, const Executor& exec) const;

    /// Holds an own vertex where it is from now on, or lets it move again: its correction is 0. All sub-meshes that
    /// share it must be told.
    void hold(Index v, bool is_held);

    /// Sets w of the attachment of an own vertex, in 1/length². Only with an attachment.
    void attach(Index v, double weight) { matrix_.screening.weights[v] = weight; }

    /// Takes K and M of other origin from now on (see SymmetricLaplacian::give).
    /// @param local_to_global all vertices in the whole mesh.
    void give(const GivenStiffness& given, std::span<const Index> local_to_global)
    {
        matrix_.laplacian->give(given, local_to_global);
    }

    /// Weighs a kept K (see SymmetricLaplacian::weigh).
    void weigh(const SquaredDifference& squared_difference) { matrix_.laplacian->weigh(squared_difference); }

    /// Takes what is kept of V⁰, and what an attachment pulls to, from other positions.
    /// @param first at least #own by 3.
    void set_reference(const Points& first);

  private:
    SparsePattern number_unknowns(const SubMesh& sub_mesh);
    [[nodiscard]] Index n_before_interface() const { return matrix_.n() - n_interface_; }
    void leave_out_held(std::span<double> matrix, const Points& increments, Points& residual) const;

    Index n_interface_;
    /// The vertices held; empty if none ever was. And their number.
    std::vector<std::uint8_t> is_held_;
    Index n_held_ = 0;
    /// If the Laplacian uses them.
    IndexLists faces_;
    SymmetricMatrix matrix_;
    /// Of the matrix's unknowns, where some are auxiliary; else empty.
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
