#include "solvers/systems/lu_matrix.h"

#include <algorithm>
#include <utility>

#include "solvers/direct/make_solver.h"
#include "solvers/systems/checks.h"

namespace seamflow {

LuMatrix::LuMatrix(std::unique_ptr<LaplacianAssembler> laplacian, SparsePattern pattern, std::vector<Index> slots,
                   std::size_t n_further, Factorisation factorisation)
    : laplacian_(std::move(laplacian))
    , pattern_(std::move(pattern))
    , slots_(std::move(slots))
    , values_(pattern_.rows.size() + n_further + 1)
{
    for (Index u = 0; u < n(); ++u)
        diagonal_slots_.push_back(pattern_.slot({u, u}));
    if (n() > 0)
        solver_ = make_general_solver(pattern_, factorisation);
}

std::span<double> LuMatrix::fill(const Points& positions, double time_step)
{
    std::fill(values_.begin(), values_.end(), 0.0);
    laplacian_->add(positions, time_step, slots_, values_);
    return std::span(values_).first(values_.size() - 1);
}

void LuMatrix::scale_rows(std::span<const double> step_scales, std::span<const Index> further)
{
    const std::size_t n_entries = pattern_.rows.size();
    for (std::size_t slot = 0; slot < n_entries; ++slot)
        values_[slot] *= step_scales[usize(pattern_.rows[slot])];
    for (std::size_t i = 0; i < further.size(); ++i)
        values_[n_entries + i] *= step_scales[usize(further[i])];
}

std::optional<DirectSolver::Factor> LuMatrix::factorise(std::span<const double> values, FactorMemory& memory,
                                                        SolverWorkspace& workspace)
{
    require_finite_equations(values);
    if (!solver_)
        return std::nullopt;
    auto factor = require_factor(solver_->factorise(values.first(pattern_.rows.size()), memory, workspace));
    n_nearly_singular_ += factor.is_nearly_singular() ? 1 : 0;
    return factor;
}

}  // namespace seamflow
