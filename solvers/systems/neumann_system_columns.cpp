#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "partition/large_arrays.h"
#include "solvers/direct/simd.h"
#include "solvers/systems/checks.h"
#include "solvers/systems/neumann_system.h"

namespace seamflow {

namespace {

/// residual = Σ k (X in this row - X in the other row) over the entries k of dt K in one row.
struct ResidualKernel {
    template <Index Width, class Entries>
    [[gnu::always_inline]] void operator()(SimdWidth<Width>, const Entries& entries, const double* x, Index own,
                                           double* residual) const
    {
        using Row = SimdBlock<double, Width, wide_ldl_row>;
        Row here;
        here.load_from(x + usize(own) * usize(wide_ldl_row));
        Row sum;
        for (const auto& [row, value] : entries) {
            Row there;
            there.load_from(x + usize(row) * usize(wide_ldl_row));
            for (Index p = 0; p < Row::n_registers; ++p)
                sum.registers[p] += value * (here.registers[p] - there.registers[p]);
        }
        for (Index p = 0; p < Row::n_registers; ++p)
            store(sum.registers[p], residual + usize(own) * usize(wide_ldl_row) + p * Row::lanes_of_register);
    }
};

/// An off-diagonal entry in the row of an unknown: the row of the other vertex, and the entry of dt K.
struct RowEntry {
    Index row;
    double value;
};

/// Per unknown, the off-diagonal entries of its row of dt K; none for fixed vertices.
/// @param row_of per vertex: its row. The n unknowns have the first rows.
/// @param pairs, entries the off-diagonal entries of dt K. A pair stands for two entries, and may be repeated.
Lists<RowEntry> list_rows(std::span<const Index> row_of, Index n, std::span<const std::uint8_t> is_fixed,
                          std::span<const VertexPair> pairs, std::span<const double> entries)
{
    return make_lists<RowEntry>(n, [&](auto&& add) {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            for (const auto& [v, other] : {pairs[i], VertexPair{pairs[i].second, pairs[i].first}})
                if (row_of[v] < n && (is_fixed.empty() || is_fixed[v] == 0))
                    add(row_of[v], RowEntry{row_of[other], entries[i]});
    });
}

}  // namespace

bool NeumannSystem::can_take_columns(const Factor& factor) const
{
    return n_interface_ == 0 && matrix_.laplacian->n_auxiliary() == 0 && !matrix_.screening.exists() &&
           !factor.is_single();
}

/// (M + dt K)(Xᵏ⁺¹ - Xᵏ) = -dt K Xᵏ, for several columns at a time, so that the factor is read from memory once for all
/// of these columns. Each thread has columns of its own.
void NeumannSystem::take_steps(const Factor& factor, double time_step, int n_steps, std::span<const Index> rows,
                               Eigen::Ref<Eigen::MatrixXd> fields, const Executor& exec) const
{
    const std::vector<VertexPair> pairs = matrix_.laplacian->pairs();
    std::vector<Index> slots(pairs.size());
    std::iota(slots.begin(), slots.end(), 0);
    std::vector<double> entries(pairs.size(), 0.0);
    std::vector<double> diagonal(usize(matrix_.n_vertices));
    std::vector<double> mass(diagonal.size());
    // K and M are kept and do not depend on the positions.
    const Points any = Points::Zero(matrix_.n_vertices, 3);
    matrix_.laplacian->assemble(any, time_step, slots, entries, diagonal, mass);
    // The unknowns in their order, then the other vertices.
    std::vector<Index> vertex_at = matrix_.vertex_of;
    std::vector<Index> row_of(diagonal.size(), -1);
    for (Index u = 0; u < matrix_.n(); ++u)
        row_of[vertex_at[u]] = u;
    for (Index v = 0; v < matrix_.n_vertices; ++v)
        if (row_of[v] < 0) {
            row_of[v] = static_cast<Index>(vertex_at.size());
            vertex_at.push_back(v);
        }
    const Lists<RowEntry> rows_of_unknowns = list_rows(row_of, matrix_.n(), is_fixed_, pairs, entries);
    const auto& numbers = std::get<LdlFactor<double>>(factor.numbers_);
    const auto n_columns = static_cast<Index>(fields.cols());
    const auto n_rows = static_cast<Index>(vertex_at.size());
    const std::size_t n_changes = usize(matrix_.n()) * usize(wide_ldl_row);
    const Index n_portions = (n_columns + wide_ldl_row - 1) / wide_ldl_row;
    std::vector<std::uint8_t> is_finite(usize(n_portions));
    exec(n_portions, [&](Index begin, Index end) {
        const auto x = uninitialised<double>(usize(n_rows) * usize(wide_ldl_row));
        const auto changes = uninitialised<double>(n_changes);
        for (Index portion = begin; portion < end; ++portion) {
            const Index first = portion * wide_ldl_row;
            const Index width = std::min(wide_ldl_row, n_columns - first);
            for (Index i = 0; i < n_rows; ++i)
                for (Index c = 0; c < wide_ldl_row; ++c)
                    x[usize(i) * usize(wide_ldl_row) + usize(c)] =
                        c < width ? fields(rows[vertex_at[i]], first + c) : 0.0;
            for (int step = 0; step < n_steps; ++step) {
                for (Index u = 0; u < matrix_.n(); ++u)
                    with_simd_width(register_width(), ResidualKernel(), rows_of_unknowns[u], x.get(), u, changes.get());
                numbers.solve_wide(changes.get());
                std::transform(x.get(), x.get() + n_changes, changes.get(), x.get(), std::plus<>());
            }
            is_finite[portion] =
                std::all_of(x.get(), x.get() + n_changes, [](double value) { return std::isfinite(value); }) ? 1 : 0;
            for (Index i = 0; i < matrix_.n(); ++i)
                for (Index c = 0; c < width; ++c)
                    fields(rows[vertex_at[i]], first + c) = x[usize(i) * usize(wide_ldl_row) + usize(c)];
        }
    });
    require_finite_result(std::ranges::find(is_finite, 0) == is_finite.end());
}

}  // namespace seamflow
