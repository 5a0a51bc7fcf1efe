#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "solvers/direct/factor_memory.h"
#include "solvers/direct/factorisation.h"
#include "solvers/direct/solver_workspace.h"
#include "solvers/sparse/symbolic_factor.h"

namespace seamflow {

/// Factorisation of sparse matrices of one pattern: analysed once, factorised for each set of values, a factor used for
/// any number of right-hand sides, three at a time. Different objects may be used by different threads at the same
/// time, each with a workspace of its own.
class DirectSolver {
  public:
    class Factor;

    virtual ~DirectSolver() = default;

    /// The kind of the current factor or the next one; never Automatic.
    [[nodiscard]] virtual Factorisation kind() const = 0;

    /// The size of a factor, in bytes; for UMFPACK an estimate. The factors of CHOLMOD and UMFPACK are in these
    /// libraries' own memory.
    [[nodiscard]] virtual std::size_t factor_bytes() const = 0;

    /// Factorises a matrix.
    /// @pre no factor exists: one at a time.
    /// @param values one per entry of the pattern; must not change while the factor is used.
    /// @param memory must outlive the factor, as must the solver.
    /// @returns nothing if a symmetric matrix is not positive definite.
    /// @throws ComputationError if a matrix that need not be symmetric is singular, or memory runs out.
    [[nodiscard]] std::optional<Factor> factorise(std::span<const double> values, FactorMemory& memory,
                                                  SolverWorkspace& workspace);

  private:
    /// @returns whether there is a factor.
    virtual bool make_factor(std::span<const double> values, FactorMemory& memory, SolverWorkspace& workspace) = 0;
    [[nodiscard]] virtual bool is_nearly_singular() const { return false; }
    virtual void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) = 0;
    virtual void free_factor() = 0;
};

/// A DirectSolver's factor of a matrix. On destruction, its memory is returned to its memory resource.
class DirectSolver::Factor {
  public:
    /// Whether a solution has three correct digits at most.
    [[nodiscard]] bool is_nearly_singular() const { return solver_->is_nearly_singular(); }

    /// Solves for three right-hand sides.
    /// @param solution receives n by 3.
    /// @throws ComputationError if CHOLMOD or UMFPACK fails.
    void solve(const Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) const
    {
        solver_->solve(right_hand_side, solution, workspace);
    }

  private:
    friend class DirectSolver;
    explicit Factor(DirectSolver& solver)
        : solver_(&solver)
    {
    }
    struct Free {
        void operator()(DirectSolver* solver) const { solver->free_factor(); }
    };
    std::unique_ptr<DirectSolver, Free> solver_;
};

inline std::optional<DirectSolver::Factor> DirectSolver::factorise(std::span<const double> values, FactorMemory& memory,
                                                                   SolverWorkspace& workspace)
{
    return make_factor(values, memory, workspace) ? std::optional(Factor(*this)) : std::nullopt;
}

}  // namespace seamflow
