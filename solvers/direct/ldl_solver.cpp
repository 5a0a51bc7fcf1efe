#include "solvers/direct/ldl_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "partition/errors.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// In numbers: how far ahead of their use backward substitution prefetches numbers, and in what portions.
constexpr std::ptrdiff_t substituted_ahead = 1024;
template <class Number>
constexpr std::ptrdiff_t cache_line = 64 / sizeof(Number);

/// Per unknown, its supernode.
std::vector<Index> blocks_of_unknowns(const SymbolicFactor& pattern)
{
    std::vector<Index> supernode_of(pattern.n());
    for (Index b = 0; b < pattern.n_supernodes(); ++b)
        std::fill_n(supernode_of.begin() + pattern.first[b], pattern.width(b), b);
    return supernode_of;
}

/// The divisor of the numbers: a power of two near the largest, and 1 in double precision.
template <class Number>
double scale_of(std::span<const double> values)
{
    double largest = 0.0;
    if constexpr (std::is_same_v<Number, float>)
        for (const double value : values)
            largest = std::max(largest, std::abs(value));
    return power_of_two_near(largest);
}

/// Whether one of a panel's pivots is smaller than that fraction of the matrix's diagonal.
template <class Number>
bool has_small_pivot(const LdlPanel<Number>& panel, const std::vector<double>& diagonal, Number least_pivot)
{
    bool is_small = false;
    for (Index c = 0; c < panel.width; ++c)
        is_small |= panel.values[at(c) * at(panel.width + 1)] < least_pivot * static_cast<Number>(diagonal[c]);
    return is_small;
}

template <class Number>
void copy_diagonal(const LdlPanel<Number>& panel, std::vector<double>& diagonal)
{
    diagonal.resize(std::max(diagonal.size(), at(panel.width)));
    for (Index c = 0; c < panel.width; ++c)
        diagonal[c] = panel.values[at(c) * at(panel.width + 1)];
}

}  // namespace

LdlSolver::LdlSolver(const SparsePattern& upper, std::optional<Index> n_last, const EliminationTree& tree)
    : n_last_(n_last.value_or(0))
    , has_rows_(n_last.has_value())
    , pattern_(make_symmetric_symbolic_factor(upper, n_last_, tree, places_))
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
    updates_ = make_lists<Update>(pattern_.n_supernodes(), for_each_update);
}

/// An entry of column j belongs to the supernode of its row, which is eliminated first; the place of j among the rows
/// of that supernode is known.
void LdlSolver::find_places(const SparsePattern& upper, const std::vector<Index>& supernode_of)
{
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const Index row = upper.rows[k];
        const Index supernode = supernode_of[row];
        places_[k] = panels_[supernode] + places_[k] * pattern_.width(supernode) + row - pattern_.first[supernode];
    }
}

template <class Number>
std::optional<LdlFactor<Number>> LdlSolver::factorise(std::span<const double> values, FactorMemory& memory,
                                                      LdlWorkspace& workspace, Number least_pivot) const
{
    auto numbers = take_numbers<Number>(memory, n_numbers());
    Number* factor = numbers.get();
    if (workspace.row_of.size() < at(n())) {
        workspace.row_of.resize(n());
        workspace.target_rows.resize(n());
    }
    auto& last = std::get<std::vector<Number>>(workspace.last);
    const std::size_t n_in_last = at(n_last_) * at(n_last_);
    last.resize(std::max(last.size(), n_in_last));
    std::fill_n(last.begin(), n_in_last, Number{});
    std::fill_n(factor, n_factor_numbers(), Number{});
    const double scale = scale_of<Number>(values.first(places_.size()));
    const double inverse = 1.0 / scale;
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const Index place = places_[k];
        (place < n_factor_numbers() ? factor[place] : last[place - n_factor_numbers()]) =
            static_cast<Number>(inverse * values[k]);
    }
    for (Index b = 0; b < pattern_.n_supernodes(); ++b) {
        LdlPanel<Number> block = panel(factor, b);
        if (panels_[b] == n_factor_numbers())
            block.values = last.data();
        copy_diagonal(block, workspace.diagonal);
        subtract_updates(block, b, factor, workspace);
        if (!factorise_panel(block) || has_small_pivot(block, workspace.diagonal, least_pivot))
            return std::nullopt;
    }
    return LdlFactor<Number>(*this, std::move(numbers), scale);
}

template <class Number>
void LdlSolver::subtract_updates(const LdlPanel<Number>& later, Index supernode, Number* factor,
                                 LdlWorkspace& workspace) const
{
    for (std::size_t i = 0; i < later.rows.size(); ++i)
        workspace.row_of[later.rows[i]] = static_cast<Index>(i);
    for (const Update& update : updates_[supernode]) {
        const LdlPanel<Number> earlier = panel(factor, update.earlier);
        const auto rows = earlier.rows.subspan(update.place);
        for (std::size_t i = 0; i < rows.size(); ++i)
            workspace.target_rows[i] = workspace.row_of[rows[i]];
        subtract_update(earlier, update.place, update.n_columns, workspace.target_rows.data(), later);
    }
}

template <class Number>
void LdlFactor<Number>::solve(const Columns& right_hand_side, Columns& solution, LdlWorkspace& workspace) const
{
    assert(solver_->n_last_ == 0);
    const Index n = solver_->n();
    const double unit = scale_of<Number>(std::span(right_hand_side.data(), at(3) * at(n)));
    // There is no last block.
    auto& rows_of_solution = std::get<std::vector<Number>>(workspace.last);
    rows_of_solution.resize(std::max(rows_of_solution.size(), at(ldl_row) * at(n)));
    Number* const x = rows_of_solution.data();
    for (Index i = 0; i < n; ++i) {
        for (Index c = 0; c < 3; ++c)
            x[ldl_row * i + c] = static_cast<Number>(right_hand_side(i, c) / unit);
        x[ldl_row * i + 3] = Number{};
    }
    forward_substitute(x, n);
    back_substitute(x, n);
    set_rows(solution, n);
    for (Index i = 0; i < n; ++i)
        for (Index c = 0; c < 3; ++c)
            solution(i, c) = unit / scale_ * x[ldl_row * i + c];
}

template <class Number>
void LdlFactor<Number>::forward_substitute(Number* x, Index n) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    for (Index b = 0; b < pattern.n_supernodes() && pattern.first[b] < n; ++b)
        forward_substitute_panel(solver_->panel(numbers_.get(), b), x);
}

template <class Number>
void LdlFactor<Number>::back_substitute(Number* x, Index n) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    const std::vector<Index>& panels = solver_->panels_;
    for (Index b = pattern.n_supernodes(); b-- > 0;)
        if (pattern.first[b] < n) {
            // Processors predict only forward access. Not in a function of its own: compilers omit calls of functions
            // that only do this.
            for (std::ptrdiff_t i = panels[b]; i < panels[b + 1]; i += cache_line<Number>)
                __builtin_prefetch(numbers_.get() + std::max(std::ptrdiff_t{0}, i - substituted_ahead));
            back_substitute_panel(solver_->panel(numbers_.get(), b), x);
        }
}

template class LdlFactor<float>;
template class LdlFactor<double>;
template std::optional<LdlFactor<float>> LdlSolver::factorise(std::span<const double>, FactorMemory&, LdlWorkspace&,
                                                              float) const;
template std::optional<LdlFactor<double>> LdlSolver::factorise(std::span<const double>, FactorMemory&, LdlWorkspace&,
                                                               double) const;

}  // namespace seamflow
