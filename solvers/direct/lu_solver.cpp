#include "solvers/direct/lu_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace seamflow {

namespace {

/// An entry of L and the entry of U across the diagonal.
using Pair = Eigen::Array2d;
constexpr Eigen::Index lower = 0;
constexpr Eigen::Index upper = 1;

/// Subtracts the contributions of some columns of a supernode from the column of L and the row of U of the unknown
/// rows[row_index].
/// @param columns the first of these columns; each has as many entries as there are rows.
template <std::size_t Width>
void subtract(const Pair* columns, std::span<const Index> rows, std::size_t row_index, Pair* elimination)
{
    std::array<const Pair*, Width> column;
    std::array<Pair, Width> factor;
    for (std::size_t c = 0; c < Width; ++c) {
        column[c] = columns + c * rows.size();
        factor[c] = column[c][row_index].reverse();
    }
    for (std::size_t m = row_index; m < rows.size(); ++m) {
        Pair sum = elimination[rows[m]];
        for (std::size_t c = 0; c < Width; ++c)
            sum -= column[c][m] * factor[c];
        elimination[rows[m]] = sum;
    }
}

/// Subtracts the contributions of any number of columns: four at once, which saves memory traffic; more at once save
/// nothing.
void subtract(const Pair* columns, Index n_columns, std::span<const Index> rows, Index row_index, Pair* elimination)
{
    for (; n_columns >= 4; n_columns -= 4, columns += 4 * rows.size())
        subtract<4>(columns, rows, usize(row_index), elimination);
    if (n_columns == 3)
        subtract<3>(columns, rows, usize(row_index), elimination);
    else if (n_columns == 2)
        subtract<2>(columns, rows, usize(row_index), elimination);
    else if (n_columns == 1)
        subtract<1>(columns, rows, usize(row_index), elimination);
}

}  // namespace

LuSolver::LuSolver(const SparsePattern& pattern)
    : pattern_(make_symbolic_factor(pattern))
{
    for (Index b = 0; b < pattern_.n_supernodes(); ++b)
        panels_.push_back(panels_.back() + usize(pattern_.width(b)) * pattern_.rows[b].size());
    list_loads(pattern);
}

/// Lists the values to load. A value belongs to its row or its column, whichever is eliminated first.
void LuSolver::list_loads(const SparsePattern& pattern)
{
    loads_ = make_lists<Load>(pattern.n(), [&](auto&& add) {
        for (Index column = 0; column < pattern.n(); ++column)
            for (Index slot = pattern.column_offsets[column]; slot < pattern.column_offsets[column + 1]; ++slot) {
                const Index row = pattern_.position[pattern.rows[slot]];
                const Index position = pattern_.position[column];
                add(std::min(row, position), Load{slot, row >= position ? 2 * row : 2 * position + 1});
            }
    });
}

std::optional<LuSolver::Factor> LuSolver::factorise(std::span<const double> values, FactorMemory& memory,
                                                    LuWorkspace& workspace) const
{
    measure_rows(values, workspace);
    workspace.elimination.assign(pattern_.n(), Pair::Zero());
    Factor factor(*this, take_numbers<Pair>(memory, panels_.back()));
    for (Index b = 0; b < pattern_.n_supernodes(); ++b)
        for (Index column = 0; column < pattern_.width(b); ++column) {
            load(pattern_.first[b] + column, values, workspace);
            eliminate(b, column, factor, workspace);
            if (!store(b, column, factor, workspace))
                return std::nullopt;
        }
    return factor;
}

/// Sets row_sizes of the workspace.
void LuSolver::measure_rows(std::span<const double> values, LuWorkspace& workspace) const
{
    workspace.row_sizes.assign(pattern_.n(), 0.0);
    for (Index u = 0; u < pattern_.n(); ++u)
        for (const auto& [slot, position] : loads_[u]) {
            const Index row = position % 2 == 0 ? position / 2 : u;
            workspace.row_sizes[row] += std::abs(values[slot]);
        }
}

/// Copies the values of the column of L and of the row of U of an unknown to the workspace.
void LuSolver::load(Index unknown, std::span<const double> values, LuWorkspace& workspace) const
{
    for (const auto& [slot, position] : loads_[unknown])
        workspace.elimination[position / 2][position % 2] = values[slot];
}

/// Subtracts the contributions of earlier columns; the columns of the same supernode are the last.
void LuSolver::eliminate(Index supernode, Index column, const Factor& factor, LuWorkspace& workspace) const
{
    Pair* elimination = workspace.elimination.data();
    const Index unknown = pattern_.first[supernode] + column;
    for (Index k = pattern_.update_offsets[unknown]; k < pattern_.update_offsets[unknown + 1]; ++k) {
        const auto [earlier, row_index] = pattern_.updates[k];
        subtract(factor.column_of(earlier, 0), pattern_.width(earlier), pattern_.rows[earlier], row_index, elimination);
    }
    subtract(factor.column_of(supernode, 0), column, pattern_.rows[supernode], column, elimination);
}

/// Moves a column and a row to the factor.
/// @returns whether the pivot is acceptable.
bool LuSolver::store(Index supernode, Index column, const Factor& factor, LuWorkspace& workspace) const
{
    constexpr double largest_multiplier = 1000.0;
    constexpr double largest_growth = 1e6;
    constexpr double least_pivot = 1e-12;
    const auto rows = pattern_.rows[supernode];
    Pair* result = factor.column_of(supernode, column);
    const double* sizes = workspace.row_sizes.data();
    const double size = sizes[rows[column]];
    const double inverse = 1.0 / workspace.elimination[rows[column]][lower];
    bool is_acceptable = std::isfinite(inverse) && std::abs(inverse) * size * least_pivot <= 1.0;
    for (std::size_t m = usize(column); m < rows.size(); ++m) {
        Pair& entry = workspace.elimination[rows[m]];
        const double multiplier = entry[lower] * inverse;
        is_acceptable &= std::abs(multiplier) * size <= largest_multiplier * sizes[rows[m]];
        is_acceptable &= std::abs(entry[upper]) <= largest_growth * size;
        result[m] = Pair(multiplier, entry[upper]);
        entry.setZero();
    }
    result[column][lower] = inverse;
    return is_acceptable;
}

void LuSolver::Factor::solve(const Columns& right_hand_side, Columns& solution, LuWorkspace& workspace) const
{
    const SymbolicFactor& pattern = solver_->pattern_;
    workspace.solution.resize(pattern.n());
    Eigen::Array4d* x = workspace.solution.data();
    for (Index v = 0; v < pattern.n(); ++v)
        x[pattern.position[v]] << right_hand_side.row(v).transpose().array(), 0.0;
    for (Index b = 0; b < pattern.n_supernodes(); ++b)
        for (Index c = 0; c < pattern.width(b); ++c) {
            const auto rows = pattern.rows[b];
            const Pair* column = column_of(b, c);
            const Eigen::Array4d known = x[rows[c]];
            for (std::size_t m = usize(c) + 1; m < rows.size(); ++m)
                x[rows[m]] -= column[m][lower] * known;
        }
    for (Index b = pattern.n_supernodes(); b-- > 0;)
        for (Index c = pattern.width(b); c-- > 0;) {
            const auto rows = pattern.rows[b];
            const Pair* row = column_of(b, c);
            Eigen::Array4d sum = x[rows[c]];
            for (std::size_t m = usize(c) + 1; m < rows.size(); ++m)
                sum -= row[m][upper] * x[rows[m]];
            x[rows[c]] = sum * row[c][lower];
        }
    for (Index v = 0; v < pattern.n(); ++v)
        solution.row(v) = x[pattern.position[v]].head<3>().matrix().transpose();
}

}  // namespace seamflow
