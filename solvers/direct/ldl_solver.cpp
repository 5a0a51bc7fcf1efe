#include "solvers/direct/ldl_solver.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "partition/errors.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// In numbers: how far before it is used what substitution goes through backwards is asked for, and in what portions.
constexpr std::ptrdiff_t substituted_ahead = 1024;
constexpr std::ptrdiff_t cache_line = 64 / sizeof(double);

/// Per unknown, its supernode.
std::vector<Index> blocks_of_unknowns(const SymbolicFactor& pattern)
{
    std::vector<Index> supernode_of(pattern.n());
    for (Index b = 0; b < pattern.n_supernodes(); ++b)
        std::fill_n(supernode_of.begin() + pattern.first[b], pattern.width(b), b);
    return supernode_of;
}

}  // namespace

LdlSolver::LdlSolver(const SparsePattern& upper, Index n_last, const EliminationTree& tree)
    : n_last_(n_last)
    , pattern_(make_symmetric_symbolic_factor(upper, n_last, tree, places_))
{
    panels_.reserve(pattern_.first.size());
    for (Index b = 0; b < pattern_.n_supernodes(); ++b) {
        const std::size_t end = at(panels_.back()) + at(pattern_.width(b)) * pattern_.rows[b].size();
        if (end > at(std::numeric_limits<Index>::max()))
            throw ComputationError("the system's factor is too large: use more sub-meshes");
        panels_.push_back(static_cast<Index>(end));
    }
    const std::vector<Index> supernode_of = blocks_of_unknowns(pattern_);
    list_updates(supernode_of);
    find_places(upper, supernode_of);
}

void LdlSolver::list_updates(const std::vector<Index>& supernode_of)
{
    const auto for_each_update = [&](auto use) {
        for (Index earlier = 0; earlier < pattern_.n_supernodes(); ++earlier) {
            const auto rows = pattern_.rows[earlier];
            const auto n_rows = static_cast<Index>(rows.size());
            for (Index place = pattern_.width(earlier), end = place; place < n_rows; place = end) {
                const Index later = supernode_of[rows[place]];
                while (end < n_rows && supernode_of[rows[end]] == later)
                    ++end;
                use(later, Update{earlier, place, end - place});
            }
        }
    };
    update_offsets_.assign(at(pattern_.n_supernodes()) + 1, 0);
    for_each_update([&](Index later, const Update&) { ++update_offsets_[later + 1]; });
    std::partial_sum(update_offsets_.begin(), update_offsets_.end(), update_offsets_.begin());
    updates_.resize(update_offsets_.back());
    std::vector<Index> next = update_offsets_;
    for_each_update([&](Index later, const Update& update) { updates_[next[later]++] = update; });
}

/// An entry of column j belongs to the supernode of its row, which is eliminated first; where j stands among the rows
/// of that supernode is known.
void LdlSolver::find_places(const SparsePattern& upper, const std::vector<Index>& supernode_of)
{
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const Index row = upper.rows[k];
        const Index supernode = supernode_of[row];
        places_[k] = panels_[supernode] + places_[k] * pattern_.width(supernode) + row - pattern_.first[supernode];
    }
}

std::optional<LdlSolver::Factor> LdlSolver::factorise(std::span<const double> values, FactorMemory& memory,
                                                      LdlWorkspace& workspace) const
{
    auto numbers = take_numbers<double>(memory, at(panels_.back()));
    double* factor = numbers.get();
    if (workspace.row_of.size() < at(n())) {
        workspace.row_of.resize(n());
        workspace.target_rows.resize(n());
    }
    std::fill_n(factor, panels_.back(), 0.0);
    for (std::size_t k = 0; k < places_.size(); ++k)
        factor[places_[k]] = values[k];
    for (Index b = 0; b < pattern_.n_supernodes(); ++b) {
        subtract_updates(b, factor, workspace);
        if (!factorise_panel(panel(factor, b)))
            return std::nullopt;
    }
    return Factor(*this, std::move(numbers));
}

void LdlSolver::subtract_updates(Index supernode, double* factor, LdlWorkspace& workspace) const
{
    const LdlPanel later = panel(factor, supernode);
    for (std::size_t i = 0; i < later.rows.size(); ++i)
        workspace.row_of[later.rows[i]] = static_cast<Index>(i);
    for (Index u = update_offsets_[supernode]; u < update_offsets_[supernode + 1]; ++u) {
        const Update& update = updates_[u];
        const LdlPanel earlier = panel(factor, update.earlier);
        const auto rows = earlier.rows.subspan(update.place);
        for (std::size_t i = 0; i < rows.size(); ++i)
            workspace.target_rows[i] = workspace.row_of[rows[i]];
        subtract_update(earlier, update.place, update.n_columns, workspace.target_rows.data(), later);
    }
}

DenseLdl LdlSolver::Factor::last() const
{
    const Index n = solver_->n_last_;
    return {n > 0 ? numbers_.get() + solver_->panels_[solver_->pattern_.n_supernodes() - 1] : nullptr, n, n};
}

void LdlSolver::Factor::solve(const Columns& right_hand_side, Columns& solution, LdlWorkspace& workspace) const
{
    const Index n = solver_->n();
    workspace.solution.resize(3 * at(n));
    Eigen::Map<Points> x(workspace.solution.data(), n, 3);
    x = right_hand_side;
    forward_substitute(x.data(), n);
    back_substitute(x.data(), n);
    set_rows(solution, n);
    solution = x;
}

void LdlSolver::Factor::forward_substitute(double* x, Index n) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    for (Index b = 0; b < pattern.n_supernodes() && pattern.first[b] < n; ++b)
        forward_substitute_panel(solver_->panel(numbers_.get(), b), x);
}

void LdlSolver::Factor::back_substitute(double* x, Index n) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    const std::vector<Index>& panels = solver_->panels_;
    for (Index b = pattern.n_supernodes(); b-- > 0;)
        if (pattern.first[b] < n) {
            // Processors foresee only ways forward. Not in a function of its own: compilers leave out calls of
            // functions that do nothing but this.
            for (std::ptrdiff_t i = panels[b]; i < panels[b + 1]; i += cache_line)
                __builtin_prefetch(numbers_.get() + std::max(std::ptrdiff_t{0}, i - substituted_ahead));
            back_substitute_panel(solver_->panel(numbers_.get(), b), x);
        }
}

}  // namespace seamflow
