#include "solvers/direct/ldl_solver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "partition/errors.h"
#include "solvers/direct/columns.h"

namespace seamflow {

namespace {

/// In numbers: the distance at which backward substitution prefetches numbers before their use, and the size of a
/// prefetched portion.
constexpr std::ptrdiff_t substituted_ahead = 1024;
template <class Number>
constexpr std::ptrdiff_t cache_line = 64 / sizeof(Number);

/// Per unknown, its supernode.
std::vector<Index> supernodes_of_unknowns(const SymbolicFactor& pattern)
{
    std::vector<Index> supernode_of(pattern.n());
    for (Index b = 0; b < pattern.n_supernodes(); ++b)
        std::fill_n(supernode_of.begin() + pattern.first[b], pattern.width(b), b);
    return supernode_of;
}

/// The divisor of the numbers: a power of two near the largest number; 1 in double precision.
template <class Number>
double scale_of(std::span<const double> values)
{
    double largest = 0.0;
    if constexpr (std::is_same_v<Number, float>)
        for (const double value : values)
            largest = std::max(largest, std::abs(value));
    return power_of_two_near(largest);
}

/// Whether a pivot of a panel does not have the expected sign, or is smaller than `least_pivot` times the matrix's
/// diagonal.
template <class Number>
bool has_small_pivot(const LdlPanel<Number>& panel, const std::vector<double>& diagonal, Number least_pivot,
                     Pivots pivots)
{
    bool is_small = false;
    for (Index c = 0; c < panel.width; ++c) {
        const Number pivot = panel.values[usize(c) * usize(panel.width + 1)];
        const auto sign = static_cast<Number>(pivots == Pivots::LikeDiagonal && diagonal[c] < 0.0 ? -1.0 : 1.0);
        is_small |= !(sign * pivot > Number{0}) || sign * pivot < least_pivot * sign * static_cast<Number>(diagonal[c]);
    }
    return is_small;
}

/// Copies the diagonal of a panel that is not yet factorised.
/// @param diagonal enlarged if it is shorter than the panel is wide.
template <class Number>
void copy_diagonal(const LdlPanel<Number>& panel, std::vector<double>& diagonal)
{
    diagonal.resize(std::max(diagonal.size(), usize(panel.width)));
    for (Index c = 0; c < panel.width; ++c)
        diagonal[c] = panel.values[usize(c) * usize(panel.width + 1)];
}

/// The most columns of a supernode that several threads factorise: with narrower supernodes a thread has more to do at
/// a time, with wider ones it waits less.
constexpr Index most_columns_of_parallel = 64;

Index most_columns(const Executor& exec)
{
    return exec ? most_columns_of_parallel : std::numeric_limits<Index>::max();
}

/// The index of each row of one panel among those of another, all ascending.
void find_target_rows(std::span<const Index> rows, std::span<const Index> among, std::vector<Index>& indices)
{
    indices.resize(rows.size());
    std::size_t row_index = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        while (among[row_index] != rows[i])
            ++row_index;
        indices[i] = static_cast<Index>(row_index);
    }
}

}  // namespace

LdlSolver::LdlSolver(const SparsePattern& upper, std::optional<Index> n_last, const EliminationTree& tree,
                     Executor exec, Pivots pivots)
    : n_last_(n_last.value_or(0))
    , has_rows_(n_last.has_value())
    , pattern_(make_symmetric_symbolic_factor(upper, n_last_, tree, slots_, most_columns(exec)))
    , exec_(std::move(exec))
    , pivots_(pivots)
{
    assert((!exec_ || n_last_ == 0) && "several threads factorise matrices without last unknowns");
    panels_.reserve(pattern_.first.size());
    for (Index b = 0; b < pattern_.n_supernodes(); ++b) {
        const std::size_t end = usize(panels_.back()) + usize(pattern_.width(b)) * pattern_.rows[b].size();
        if (end > usize(std::numeric_limits<Index>::max()))
            throw ComputationError("the system's factor is too large: use more sub-meshes");
        panels_.push_back(static_cast<Index>(end));
    }
    const std::vector<Index> supernode_of = supernodes_of_unknowns(pattern_);
    list_updates(supernode_of);
    find_slots(upper, supernode_of);
    if (exec_)
        schedule_ = schedule_elimination(pattern_, supernode_of);
    if (schedule_.exists())
        list_targets();
}

/// Fills updates_: a supernode updates each later one that has some of its rows.
void LdlSolver::list_updates(const std::vector<Index>& supernode_of)
{
    const auto for_each_update = [&](auto use) {
        for (Index earlier = 0; earlier < pattern_.n_supernodes(); ++earlier) {
            const auto rows = pattern_.rows[earlier];
            const auto n_rows = static_cast<Index>(rows.size());
            for (Index row_index = pattern_.width(earlier), end = row_index; row_index < n_rows; row_index = end) {
                const Index later = supernode_of[rows[row_index]];
                while (end < n_rows && supernode_of[rows[end]] == later)
                    ++end;
                use(later, Update{earlier, row_index, end - row_index});
            }
        }
    };
    updates_ = make_lists<Update>(pattern_.n_supernodes(), for_each_update);
}

/// Moves the updates by supernodes above the groups from the lists of their targets to lists of their own.
void LdlSolver::list_targets()
{
    const std::vector<Index>& index_above = schedule_.index_above;
    targets_ = make_lists<Update>(static_cast<Index>(schedule_.above.size()), [&](auto&& add) {
        for (const Index later : schedule_.above)
            for (const Update& update : updates_[later])
                if (index_above[update.supernode] >= 0)
                    add(index_above[update.supernode], Update{later, update.row_index, update.n_columns});
    });
    updates_ = make_lists<Update>(pattern_.n_supernodes(), [&, all = std::move(updates_)](auto&& add) {
        for (Index later = 0; later < pattern_.n_supernodes(); ++later)
            for (const Update& update : all[later])
                if (index_above[update.supernode] < 0)
                    add(later, update);
    });
}

/// Replaces slots_, in which each entry has the index of its column among the rows of its supernode, by the index of
/// each entry in the factor. An entry belongs to the supernode of its row, which is eliminated before its column.
void LdlSolver::find_slots(const SparsePattern& upper, const std::vector<Index>& supernode_of)
{
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        const Index row = upper.rows[k];
        const Index supernode = supernode_of[row];
        slots_[k] = panels_[supernode] + slots_[k] * pattern_.width(supernode) + row - pattern_.first[supernode];
    }
}

template <class Number>
std::optional<LdlFactor<Number>> LdlSolver::factorise(std::span<const double> values, FactorMemory& memory,
                                                      LdlWorkspace& workspace, Number least_pivot) const
{
    auto numbers = take_numbers<Number>(memory, n_numbers());
    Number* factor = numbers.get();
    enlarge(workspace);
    auto& last = std::get<std::vector<Number>>(workspace.last);
    const std::size_t n_in_last = usize(n_last_) * usize(n_last_);
    last.resize(std::max(last.size(), n_in_last));
    std::fill_n(last.begin(), n_in_last, Number{});
    std::fill_n(factor, n_factor_numbers(), Number{});
    const double scale = scale_of<Number>(values.first(slots_.size()));
    const double inverse = 1.0 / scale;
    for (std::size_t k = 0; k < slots_.size(); ++k) {
        const Index slot = slots_[k];
        (slot < n_factor_numbers() ? factor[slot] : last[slot - n_factor_numbers()]) =
            static_cast<Number>(inverse * values[k]);
    }
    bool has_pivots = !schedule_.exists() || factorise_by_subtrees(factor, least_pivot);
    const Index n_in_order = schedule_.exists() ? 0 : pattern_.n_supernodes();
    for (Index b = 0; b < n_in_order && has_pivots; ++b) {
        LdlPanel<Number> block = panel(factor, b);
        if (panels_[b] == n_factor_numbers())
            block.values = last.data();
        has_pivots = factorise_supernode(b, block, factor, workspace, least_pivot);
    }
    return has_pivots ? std::optional(LdlFactor<Number>(*this, std::move(numbers), scale)) : std::nullopt;
}

/// Enlarges a workspace to the number of unknowns.
void LdlSolver::enlarge(LdlWorkspace& workspace) const
{
    if (workspace.row_of.size() < usize(n())) {
        workspace.row_of.resize(n());
        workspace.target_rows.resize(n());
    }
}

/// Factorises one supernode.
/// @returns whether its pivots are large enough.
template <class Number>
bool LdlSolver::factorise_supernode(Index supernode, const LdlPanel<Number>& panel, Number* factor,
                                    LdlWorkspace& workspace, Number least_pivot) const
{
    copy_diagonal(panel, workspace.diagonal);
    subtract_updates(panel, supernode, factor, workspace);
    return factorise_panel(panel) && !has_small_pivot(panel, workspace.diagonal, least_pivot, pivots_);
}

/// Factorises the groups; subtracts their updates from the supernodes above them; factorises these one by one, and
/// subtracts each one's updates from later ones.
/// @returns whether all pivots are large enough.
template <class Number>
bool LdlSolver::factorise_by_subtrees(Number* factor, Number least_pivot) const
{
    const auto n_groups = schedule_.groups.size();
    const auto n_above = static_cast<Index>(schedule_.above.size());
    std::vector<std::uint8_t> has_pivots(usize(n_groups), 0);
    exec_(n_groups, [&](Index begin, Index end) {
        LdlWorkspace workspace;
        enlarge(workspace);
        const auto factorise = [&](Index b) {
            return factorise_supernode(b, panel(factor, b), factor, workspace, least_pivot);
        };
        for (Index group = begin; group < end; ++group)
            has_pivots[group] = std::ranges::all_of(schedule_.groups[group], factorise) ? 1 : 0;
    });
    if (std::ranges::find(has_pivots, 0) != has_pivots.end())
        return false;
    std::vector<std::vector<double>> diagonals(usize(n_above));
    exec_(n_above, [&](Index begin, Index end) {
        LdlWorkspace workspace;
        enlarge(workspace);
        for (Index i = begin; i < end; ++i) {
            const LdlPanel<Number> later = panel(factor, schedule_.above[i]);
            copy_diagonal(later, diagonals[i]);
            subtract_updates(later, schedule_.above[i], factor, workspace);
        }
    });
    for (Index i = 0; i < n_above; ++i) {
        const LdlPanel<Number> earlier = panel(factor, schedule_.above[i]);
        if (!factorise_panel(earlier) || has_small_pivot(earlier, diagonals[i], least_pivot, pivots_))
            return false;
        subtract_from_targets(i, factor);
    }
    return true;
}

/// Subtracts the updates of a factorised supernode above the groups from later supernodes.
/// @param above its index in schedule_.above.
template <class Number>
void LdlSolver::subtract_from_targets(Index above, Number* factor) const
{
    const LdlPanel<Number> earlier = panel(factor, schedule_.above[above]);
    const std::span<const Update> targets = targets_[above];
    exec_(static_cast<Index>(targets.size()), [&](Index begin, Index end) {
        std::vector<Index> target_rows;
        for (const Update& target : targets.subspan(usize(begin), usize(end - begin))) {
            const LdlPanel<Number> later = panel(factor, target.supernode);
            find_target_rows(earlier.rows.subspan(usize(target.row_index)), later.rows, target_rows);
            subtract_update(earlier, target.row_index, target.n_columns, target_rows.data(), later);
        }
    });
}

/// Subtracts the updates of earlier supernodes (updates_) from the panel of a supernode.
template <class Number>
void LdlSolver::subtract_updates(const LdlPanel<Number>& later, Index supernode, Number* factor,
                                 LdlWorkspace& workspace) const
{
    for (std::size_t i = 0; i < later.rows.size(); ++i)
        workspace.row_of[later.rows[i]] = static_cast<Index>(i);
    for (const Update& update : updates_[supernode]) {
        const LdlPanel<Number> earlier = panel(factor, update.supernode);
        const auto rows = earlier.rows.subspan(update.row_index);
        for (std::size_t i = 0; i < rows.size(); ++i)
            workspace.target_rows[i] = workspace.row_of[rows[i]];
        subtract_update(earlier, update.row_index, update.n_columns, workspace.target_rows.data(), later);
    }
}

template <class Number>
void LdlFactor<Number>::solve(const Columns& right_hand_side, Columns& solution, LdlWorkspace& workspace) const
{
    assert(solver_->n_last_ == 0);
    const Index n = solver_->n();
    const double unit = scale_of<Number>(std::span(right_hand_side.data(), usize(3) * usize(n)));
    // Without last unknowns, the memory of their block is free for the solution.
    auto& rows_of_solution = std::get<std::vector<Number>>(workspace.last);
    rows_of_solution.resize(std::max(rows_of_solution.size(), usize(ldl_row) * usize(n)));
    Number* const x = rows_of_solution.data();
    for (Index i = 0; i < n; ++i) {
        for (Index c = 0; c < 3; ++c)
            x[ldl_row * i + c] = static_cast<Number>(right_hand_side(i, c) / unit);
        x[ldl_row * i + 3] = Number{};
    }
    forward_substitute<ldl_row>(x, n);
    back_substitute<ldl_row>(x, n);
    set_rows(solution, n);
    for (Index i = 0; i < n; ++i)
        for (Index c = 0; c < 3; ++c)
            solution(i, c) = unit / scale_ * x[ldl_row * i + c];
}

template <class Number>
void LdlFactor<Number>::solve_wide(Number* x) const requires std::is_same_v<Number, double>
{
    assert(solver_->n_last_ == 0);
    forward_substitute<wide_ldl_row>(x, solver_->n());
    for (Index b = solver_->pattern_.n_supernodes(); b-- > 0;)
        back_substitute_supernode<wide_ldl_row>(x, b);
}

template <class Number>
void LdlFactor<Number>::forward_substitute()
{
    forward_substitute<ldl_row>(rows(), solver_->n() - solver_->n_last_);
}

template <class Number>
void LdlFactor<Number>::back_substitute()
{
    back_substitute<ldl_row>(rows(), solver_->n() - solver_->n_last_);
}

template <class Number>
template <Index Length>
void LdlFactor<Number>::forward_substitute(Number* x, Index n) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    for (Index b = 0; b < pattern.n_supernodes() && pattern.first[b] < n; ++b)
        forward_substitute_panel<Length>(solver_->panel(numbers_.get(), b), x);
}

template <class Number>
template <Index Length>
void LdlFactor<Number>::back_substitute(Number* x, Index n) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    const EliminationSchedule& schedule = solver_->schedule_;
    if (schedule.exists()) {
        for (std::size_t i = schedule.above.size(); i-- > 0;)
            back_substitute_supernode<Length>(x, schedule.above[i]);
        for_each(solver_->exec_, schedule.groups.size(), [&](Index group) {
            const std::span<const Index> supernodes = schedule.groups[group];
            for (std::size_t i = supernodes.size(); i-- > 0;)
                back_substitute_supernode<Length>(x, supernodes[i]);
        });
        return;
    }
    for (Index b = pattern.n_supernodes(); b-- > 0;)
        if (pattern.first[b] < n)
            back_substitute_supernode<Length>(x, b);
}

/// Numbers are prefetched, because processors predict only forward access.
template <class Number>
template <Index Length>
void LdlFactor<Number>::back_substitute_supernode(Number* x, Index supernode) const
{
    const std::vector<Index>& panels = solver_->panels_;
    for (std::ptrdiff_t i = panels[supernode]; i < panels[supernode + 1]; i += cache_line<Number>)
        __builtin_prefetch(numbers_.get() + std::max(std::ptrdiff_t{0}, i - substituted_ahead));
    back_substitute_panel<Length>(solver_->panel(numbers_.get(), supernode), x);
}

template class LdlFactor<float>;
template class LdlFactor<double>;
template std::optional<LdlFactor<float>> LdlSolver::factorise(std::span<const double>, FactorMemory&, LdlWorkspace&,
                                                              float) const;
template std::optional<LdlFactor<double>> LdlSolver::factorise(std::span<const double>, FactorMemory&, LdlWorkspace&,
                                                               double) const;

}  // namespace seamflow
