#include "solvers/symmetric_solver.h"

#include <utility>

#include "solvers/set_rows.h"

namespace seamflow {

namespace {

/// Above this number of unknowns CHOLMOD is faster (measured on triangle meshes).
constexpr Index most_unknowns_for_ldl = 500'000;

}  // namespace

SymmetricSolver::SymmetricSolver(SparsePattern upper, SolverWorkspace& workspace, const EliminationTree& tree)
{
    if (upper.n() <= most_unknowns_for_ldl) {
        ldl_ = std::make_unique<LdlSolver>(upper, 0, tree);
        return;
    }
    upper_ = std::move(upper);
    cholmod_ = std::make_unique<CholmodSolver>(upper_, workspace.cholmod);
}

std::size_t SymmetricSolver::factor_bytes() const
{
    return ldl_ ? ldl_->factor_bytes() : cholmod_->factor_bytes();
}

bool SymmetricSolver::factorise(std::span<const double> values, SolverWorkspace& workspace)
{
    return ldl_ ? ldl_->factorise(values, *workspace.factors, workspace.ldl)
                : cholmod_->factorise(values, workspace.cholmod);
}

void SymmetricSolver::solve(Columns& right_hand_side, Columns& solution, SolverWorkspace& workspace) const
{
    set_rows(solution, right_hand_side.rows());
    if (ldl_)
        ldl_->solve(right_hand_side, solution, workspace.ldl);
    else
        solution = cholmod_->solve(right_hand_side, workspace.cholmod);
}

void SymmetricSolver::free_factor(FactorMemory& memory)
{
    if (ldl_)
        ldl_->free_factor(memory);
    else
        cholmod_->free_factor();
}

}  // namespace seamflow
