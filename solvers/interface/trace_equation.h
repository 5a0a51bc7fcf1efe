#pragma once

#include <functional>
#include <span>
#include <vector>

#include "partition/loop.h"
#include "solvers/krylov/gmres.h"
#include "solvers/systems/schwarz_block.h"

namespace seamflow {

/// How the iteration for the trace equation ended.
struct TraceResult : IterationResult {
    /// The longest row of the residual, in length, times the typical amplification of residuals (see GmresCycle). It
    /// estimates the largest distance to the exact step, rather too high, since the blocks' last solve reduces the
    /// error further.
    double estimated_distance = 0.0;
};

/// The whole backward Euler step as an equation on traces: g are the positions of those vertices that occur in the
/// equations of a block (see SchwarzBlock) without being among its unknowns. Every block, solved with g given, finds
/// its own vertices anew; the step is where nothing changes by that, g = T g + c. Solved for x, y and z at once by
/// GMRES, which is restricted additive Schwarz as preconditioner of the whole system (Cai and Sarkis 1999), but with
/// vectors on the traces alone. Residuals are lengths. Sums are taken in a fixed order: the bits do not depend on how
/// loops are run.
class TraceEquation {
  public:
    /// How the work on many blocks is run, and what the calling thread works with.
    struct Threads {
        Loop loop;
        std::function<SolverWorkspace&()> workspace;
    };

    /// @param blocks of parts that share out the mesh; the same, in the same order, wherever blocks are asked for.
    /// @param n_vertices of the whole mesh.
    TraceEquation(std::span<SchwarzBlock* const> blocks, Index n_vertices);

    /// Number of vertices in the equation.
    [[nodiscard]] Index size() const { return first_.back(); }

    /// Solves.
    /// @param blocks factorised.
    /// @param stop residual relative to that at the beginning, in the Euclidean norm over x, y and z; or to what
    ///        rounding alone makes of the positions, whatever is larger. The tolerance is positive.
    /// @param x #V by 3. In: Vᵏ, where the iteration starts. Out: Vᵏ⁺¹.
    /// @throws ComputationError if a result is not finite.
    TraceResult solve(std::span<SchwarzBlock* const> blocks, const IterationStop& stop, Points& x,
                      const Threads& threads);

  private:
    /// What a block takes from the traces and gives to them.
    struct Ends {
        /// For each of the vertices beyond, its number in the equation.
        std::vector<Index> inputs;
        /// Those of its unknowns that are in the equation; their numbers follow each other.
        std::vector<Index> outputs;
    };

    void solve_block(SchwarzBlock& block, const Ends& ends, const Points& traces,
                     SchwarzBlock::RightHandSide right_hand_side, SolverWorkspace& workspace) const;
    void renew(std::span<SchwarzBlock* const> blocks, Points& x, const Threads& threads);
    void multiply(std::span<SchwarzBlock* const> blocks, const Points& p, Points& product,
                  const Threads& threads) const;

    std::vector<Ends> ends_;
    /// Per block, the number of its first output; then the number of all.
    std::vector<Index> first_{0};
    Points traces_;
    Points residual_;
    KrylovBasis basis_;
};

}  // namespace seamflow
