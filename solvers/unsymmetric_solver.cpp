#include "solvers/unsymmetric_solver.h"

namespace seamflow {

namespace {

/// Above this number of unknowns UMFPACK is faster where rows have many entries (measured: two-ring rows on hexagons).
constexpr Index most_unknowns_for_lu = 20'000;

}  // namespace

UnsymmetricSolver::UnsymmetricSolver(const SparsePattern& pattern)
    : pattern_(&pattern)
{
    if (pattern.n() <= most_unknowns_for_lu)
        lu_ = std::make_unique<LuSolver>(pattern);
    else
        umfpack_ = std::make_unique<UmfpackSolver>(pattern);
}

std::size_t UnsymmetricSolver::factor_bytes() const
{
    return lu_ ? lu_->factor_bytes() : umfpack_->factor_bytes();
}

void UnsymmetricSolver::factorise(std::span<const double> values, SolverWorkspace& workspace)
{
    is_nearly_singular_ = false;
    if (lu_ && lu_->factorise(values, *workspace.factors, workspace.lu))
        return;
    if (!umfpack_)
        umfpack_ = std::make_unique<UmfpackSolver>(*pattern_);
    umfpack_->factorise(values);
    is_nearly_singular_ = umfpack_->is_nearly_singular();
}

void UnsymmetricSolver::solve(std::span<const double> values, const Columns& right_hand_side, Columns& solution,
                              SolverWorkspace& workspace)
{
    if (lu_ && lu_->has_factor())
        lu_->solve(right_hand_side, solution, workspace.lu);
    else
        umfpack_->solve(values, right_hand_side, solution);
}

void UnsymmetricSolver::free_factor(FactorMemory& memory)
{
    if (lu_)
        lu_->free_factor(memory);
    if (umfpack_)
        umfpack_->free_factor();
}

}  // namespace seamflow
