#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "partition/executor.h"
#include "solvers/interface/interface_result.h"
#include "solvers/krylov/gmres.h"
#include "solvers/systems/schwarz_block.h"

namespace seamflow {

/// The whole backward Euler step as an equation on traces: g are the positions of those vertices that occur in the
/// equations of a block (see SchwarzBlock) without being among its unknowns. Every block, solved with g given, yields
/// new positions of its own vertices; the step is the fixed point g = T g + c. Solved for x, y and z at once by GMRES,
/// which is restricted additive Schwarz as preconditioner of the whole system (Cai and Sarkis 1999), but with vectors
/// on the traces only. Residuals are lengths. Sums are taken in a fixed order: the bits do not depend on how loops are
/// run.
class TraceEquation {
  public:
    /// How work on many blocks is run, and the workspace of the calling thread.
    struct Threads {
        Executor exec;
        std::function<SolverWorkspace&()> workspace;
    };

    /// Blocks of parts that partition the mesh.
    using Blocks = std::span<const std::unique_ptr<SchwarzBlock>>;
    /// The same blocks, in the same order, each with its factor of a step.
    struct FactorisedBlocks {
        Blocks blocks;
        std::span<const SchwarzBlock::Factor> factors;
    };

    /// @param n_vertices of the whole mesh.
    TraceEquation(Blocks blocks, Index n_vertices);

    /// Number of vertices in the equation.
    [[nodiscard]] Index size() const { return first_.back(); }

    /// Solves.
    /// @param stop residual relative to that at the beginning, in the Euclidean norm over x, y and z; or to the
    ///        rounding error of the positions, whichever is larger. The tolerance is positive.
    /// @param x #V by 3. In: Vᵏ, where the iteration starts. Out: Vᵏ⁺¹.
    /// @returns as distance the longest row of the residual times the typical amplification of residuals (see
    ///          GmresCycle): rather too high, since the blocks' last solve reduces the error further.
    /// @throws ComputationError if a result is not finite.
    InterfaceResult solve(const FactorisedBlocks& system, const IterationStop& stop, Points& x, const Threads& threads);

  private:
    /// A block's inputs from the traces and outputs to them.
    struct Ends {
        /// For each of the vertices beyond, its number in the equation.
        std::vector<Index> inputs;
        /// Its unknowns that are in the equation; their numbers are consecutive.
        std::vector<Index> outputs;
    };

    void solve_block(const FactorisedBlocks& system, Index s, const Points& traces,
                     SchwarzBlock::RightHandSide right_hand_side, SolverWorkspace& workspace) const;
    void renew(const FactorisedBlocks& system, Points& x, const Threads& threads);
    void multiply(const FactorisedBlocks& system, const Points& p, Points& product, const Threads& threads) const;

    std::vector<Ends> ends_;
    /// Per block, the number of its first output; then the number of all.
    std::vector<Index> first_{0};
    Points traces_;
    Points residual_;
    KrylovBasis basis_;
};

}  // namespace seamflow
