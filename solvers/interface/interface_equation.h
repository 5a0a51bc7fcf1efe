#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "partition/decomposition/decomposition.h"
#include "partition/executor.h"
#include "solvers/direct/dense_factor.h"
#include "solvers/interface/coarse_space.h"
#include "solvers/interface/interface_copies.h"
#include "solvers/interface/interface_ranks.h"
#include "solvers/interface/interface_result.h"
#include "solvers/interface/interface_sums.h"
#include "solvers/krylov/conjugate_gradients.h"

namespace seamflow {

/// Whether the preconditioner is balanced by a CoarseSpace. This takes fewer iterations, but each iteration and the
/// start of each solution cost more. It pays if sub-meshes are narrow relative to √dt.
enum class Balancing {
    None,
    Coarse,
};

/// The whole backward Euler step as an equation for x = Vᵏ⁺¹ - Vᵏ on Γ alone:
///
/// \f[ S\, x = \sum_i S_i\, x = \sum_i g_i , \qquad
///     S_i = A_{\Gamma\Gamma} - A_{\Gamma I}\, A_{II}^{-1} A_{I\Gamma} , \f]
///
/// sums over the sub-meshes, each with the Schur complement of its share A = M + dt K (see NeumannSystem), its interior
/// I condensed. Solved for all three columns at once by conjugate gradients, preconditioned by Σ W_i S_i⁻¹ W_i with
/// weights that add up to 1 at each vertex (Neumann-Neumann), balanced or not. The products are in single precision, in
/// units that fit it; the residual is recomputed, without a restart, from that of the whole step in double precision.
/// So neither these products nor the factors of sub-meshes limit a tolerance. Sums are taken sub-mesh by sub-mesh and
/// along a tree of sub-meshes (see InterfaceSums): the bits do not depend on how loops are run.
class InterfaceEquation {
  public:
    /// @param decomposition without overlap; needed only during the call.
    /// @param ranks the ranks that solve the equation together; must outlive the equation. All ranks construct it
    /// together.
    /// @throws ComputationError if an analysis fails.
    InterfaceEquation(const Decomposition& decomposition, Balancing balancing, InterfaceRanks& ranks);
    InterfaceEquation(const InterfaceEquation&) = delete;
    InterfaceEquation& operator=(const InterfaceEquation&) = delete;

    [[nodiscard]] const InterfaceCopies& copies() const { return copies_; }

    /// Fixes a vertex of Γ, where x is exactly 0 from then on, or lets it move again. The complements of the next
    /// solution must be new (are_known false). In a fixed vertex's rows and columns they are diagonal, and the
    /// right-hand sides are 0.
    void set_fixed(Index vertex, bool is_fixed);

    /// The residual of the step on Γ at x, the interiors being solved for: returns one row per copy, with each own
    /// sub-mesh's share. The equation fills in the rows of copies in remote sub-meshes.
    using Residuals = std::function<Points&(const Points& x)>;

    /// Solves; all ranks call this together.
    /// @param complements one per sub-mesh; the complements of remote sub-meshes are not read.
    /// @param are_known whether the complements are those of the last solution.
    /// @param right_hand_sides one row per copy: each own sub-mesh's share g_i. Receives the rows of remote sub-meshes.
    /// @param residuals recomputes the residual; called every few iterations.
    /// @param stop residual relative to that of x = 0, in the Euclidean norm, for each coordinate.
    /// @param guess one row per vertex of Γ: a direction in which the solution may be expected; null if unknown.
    /// @param x receives the solution, one row per vertex of Γ.
    /// @returns the largest of the three coordinates' residuals; as distance the largest row of the preconditioned
    ///          residual, scaled like the last iteration.
    /// @throws ComputationError if the right-hand side or the result is not finite.
    InterfaceResult solve(std::span<const DenseFactor> complements, bool are_known, Points& right_hand_sides,
                          const Residuals& residuals, const Points* guess, const IterationStop& stop, Points& x,
                          const Executor& exec);

  private:
    [[nodiscard]] bool is_fixed(Index vertex) const { return !is_fixed_.empty() && is_fixed_[vertex] != 0; }
    void weigh_copies(std::span<const DenseFactor> complements, const Executor& exec);
    void sum_copies(Points& copies, Points& sums, const Executor& exec);
    void set_initial_solution(const MapPoints& multiply, const Points* guess, const Point& unit, Points& x,
                              const Executor& exec);
    Point measure_right_hand_side();
    [[nodiscard]] double estimate_distance(const Point& unit);
    void multiply(std::span<const DenseFactor> complements, const Points& direction, Points& product,
                  const Executor& exec);
    void precondition(std::span<const DenseFactor> complements, const Points& residual, Points& preconditioned,
                      const Executor& exec);
    template <class Apply>
    void sum_over_sub_meshes(std::span<const DenseFactor> complements, const Points& source, bool weighted,
                             Points& target, const Executor& exec, Apply&& apply);

    InterfaceRanks* ranks_;
    InterfaceCopies copies_;
    SharedRows shared_;
    std::optional<CoarseSpace> coarse_;
    /// Per copy: its weight W_i; 0 for a fixed vertex, which neither the preconditioner nor the coarse space then
    /// moves.
    std::vector<double> weights_;
    /// Per vertex of Γ: 1 if it is fixed; empty if none has ever been fixed.
    std::vector<std::uint8_t> is_fixed_;
    /// Per sub-mesh, three columns for its rows and three for the result; and the index at which the columns of each
    /// sub-mesh begin.
    AlignedFloats products_;
    std::vector<std::size_t> first_product_;
    /// #copies by 3: the results of each sub-mesh, before they are summed.
    Points residual_copies_;
    Points right_hand_side_;
    InterfaceSums sums_;
    ConjugateGradientVectors vectors_;
};

}  // namespace seamflow
