#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "partition/decomposition/overlap.h"
#include "solvers/systems/lu_matrix.h"

namespace seamflow {

/// The equations (I + dt Δ) V^{k+1} = V^k of the whole mesh at the vertices of a grown part, for any Laplacian: solved
/// by an LU factorisation with all other vertices given (one block of an overlapping Schwarz method). The pattern is
/// made and analysed once; each step refills the values in place.
class SchwarzBlock {
  public:
    /// Layers of faces beyond the equations that they depend on (see make_grown_part): Δ_P has the widest rows.
    static constexpr int reach = 2;

    /// @param part must outlive the block.
    /// @param strengths one per vertex of the mesh (see FlowTerms::strengths), needed only during the call.
    /// @throws ComputationError if the analysis fails.
    SchwarzBlock(const GrownPart& part, Laplacian laplacian, Factorisation factorisation = Factorisation::Automatic,
                 std::span<const double> strengths = {});

    /// The vertices of the equations, and those others that may move and occur in them, local to the part; ascending.
    [[nodiscard]] const std::vector<Index>& unknowns() const { return part_->unknowns; }
    [[nodiscard]] const std::vector<Index>& beyond() const { return beyond_; }

    [[nodiscard]] const SubMesh& sub_mesh() const { return part_->sub_mesh; }

    /// Size of a factor, in bytes; for UMFPACK an estimate.
    [[nodiscard]] std::size_t factor_bytes() const
    {
        return matrix_->solver() != nullptr ? matrix_->solver()->factor_bytes() : 0;
    }

    /// Kind of the factorisation (see DirectSolver::kind); empty without unknowns.
    [[nodiscard]] std::optional<Factorisation> factorisation() const
    {
        return matrix_->solver() != nullptr ? std::optional(matrix_->solver()->kind()) : std::nullopt;
    }

    /// The equations of a step, in the block: valid until it assembles again.
    struct Assembled {
        std::span<const double> values;
    };
    /// Empty without unknowns.
    using Factor = std::optional<DirectSolver::Factor>;

    /// Assembles the equations for Vᵏ.
    /// @param positions #local by 3: Vᵏ.
    [[nodiscard]] Assembled assemble(const Points& positions, double time_step);

    /// @param memory must outlive the factor, as must the block.
    /// @throws ComputationError if the equations are singular or not finite.
    [[nodiscard]] Factor factorise(const Assembled& equations, FactorMemory& memory, SolverWorkspace& workspace)
    {
        return matrix_->factorise(equations.values, memory, workspace);
    }

    /// How many factorisations so far were of equations that are nearly singular: three correct digits at most.
    [[nodiscard]] Index n_nearly_singular() const { return matrix_->n_nearly_singular(); }

    /// The right-hand side besides the contribution of the vertices beyond.
    enum class RightHandSide {
        /// That of the step.
        Step,
        /// None: the response to the vertices beyond alone, linear in them.
        Zero,
    };

    /// Solves with the vertices beyond given.
    /// @param given #beyond by 3.
    /// @param solution receives #unknowns by 3.
    /// @throws ComputationError if the result is not finite.
    void solve(const Factor& factor, const Points& given, RightHandSide right_hand_side, Columns& solution,
               SolverWorkspace& workspace) const;

  private:
    /// Place of a coefficient of an equation whose column is not an unknown.
    struct Coupling {
        Index unknown = 0;
        /// Local; in `beyond_couplings_` its place in `beyond_`.
        Index vertex = 0;
        friend auto operator<=>(const Coupling&, const Coupling&) = default;
    };

    void list_couplings(const std::vector<MatrixEntry>& entries, const std::vector<Index>& unknown_of);
    std::vector<Index> make_slots(const std::vector<MatrixEntry>& entries, const std::vector<Index>& unknown_of,
                                  const SparsePattern& pattern);

    const GrownPart* part_;
    std::vector<Index> beyond_;
    std::vector<Coupling> beyond_couplings_;
    std::vector<Coupling> fixed_couplings_;
    /// Its further values are those of `beyond_couplings_`, then of `fixed_couplings_`.
    std::optional<LuMatrix> matrix_;
    /// Per unknown its strength, and the unknown of each further value; empty: 1 everywhere.
    std::vector<double> strengths_;
    std::vector<Index> further_;
    /// #unknowns by 3, with contributions of fixed vertices.
    Columns right_hand_side_;
};

}  // namespace seamflow
