#include "solvers/systems/wide_steps.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "partition/large_arrays.h"
#include "solvers/direct/simd.h"
#include "solvers/systems/checks.h"

namespace seamflow {

namespace {

/// residual = Σ k (X at the row - X at the other) for one row, k being the entries of dt K.
struct ResidualKernel {
    template <Index Width, class Entries>
    [[gnu::always_inline]] void operator()(SimdWidth<Width>, const Entries& entries, const double* x, Index own,
                                           double* residual) const
    {
        using Row = SimdBlock<double, Width, wide_ldl_row>;
        Row here;
        here.load_from(x + usize(own) * usize(wide_ldl_row));
        Row sum;
        for (const auto& [place, value] : entries) {
            Row there;
            there.load_from(x + usize(place) * usize(wide_ldl_row));
            for (Index p = 0; p < Row::n_parts; ++p)
                sum.part[p] += value * (here.part[p] - there.part[p]);
        }
        for (Index p = 0; p < Row::n_parts; ++p)
            store(sum.part[p], residual + usize(own) * usize(wide_ldl_row) + p * Row::lanes_of_part);
    }
};

}  // namespace

WideSteps::WideSteps(std::span<const Index> unknown_of, Index n, std::span<const std::uint8_t> is_held,
                     std::span<const VertexPair> pairs, std::span<const double> entries)
    : n_(n)
    , vertex_at_(unknown_of.size())
{
    std::vector<Index> place_of(unknown_of.begin(), unknown_of.end());
    for (Index v = 0, next = n; v < static_cast<Index>(place_of.size()); ++v) {
        if (place_of[v] < 0)
            place_of[v] = next++;
        vertex_at_[place_of[v]] = v;
    }
    entries_ = make_lists<Entry>(n, [&](auto&& add) {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            for (const auto& [v, other] : {pairs[i], VertexPair{pairs[i].second, pairs[i].first}})
                if (unknown_of[v] >= 0 && (is_held.empty() || is_held[v] == 0))
                    add(unknown_of[v], Entry{place_of[other], entries[i]});
    });
}

void WideSteps::take(const LdlFactor<double>& factor, int n_steps, std::span<const Index> rows,
                     Eigen::Ref<Eigen::MatrixXd> fields, const Executor& exec) const
{
    const auto n_columns = static_cast<Index>(fields.cols());
    const auto n_places = static_cast<Index>(vertex_at_.size());
    const std::size_t n_changes = usize(n_) * usize(wide_ldl_row);
    const Index n_portions = (n_columns + wide_ldl_row - 1) / wide_ldl_row;
    std::vector<std::uint8_t> is_finite(usize(n_portions));
    exec(n_portions, [&](Index begin, Index end) {
        const auto x = uninitialised<double>(usize(n_places) * usize(wide_ldl_row));
        const auto changes = uninitialised<double>(n_changes);
        for (Index portion = begin; portion < end; ++portion) {
            const Index first = portion * wide_ldl_row;
            const Index width = std::min(wide_ldl_row, n_columns - first);
            for (Index i = 0; i < n_places; ++i)
                for (Index c = 0; c < wide_ldl_row; ++c)
                    x[usize(i) * usize(wide_ldl_row) + usize(c)] =
                        c < width ? fields(rows[vertex_at_[i]], first + c) : 0.0;
            for (int step = 0; step < n_steps; ++step) {
                for (Index u = 0; u < n_; ++u)
                    with_simd_width(register_width(), ResidualKernel(), entries_[u], x.get(), u, changes.get());
                factor.solve_wide(changes.get());
                std::transform(x.get(), x.get() + n_changes, changes.get(), x.get(), std::plus<>());
            }
            is_finite[portion] =
                std::all_of(x.get(), x.get() + n_changes, [](double value) { return std::isfinite(value); }) ? 1 : 0;
            for (Index i = 0; i < n_; ++i)
                for (Index c = 0; c < width; ++c)
                    fields(rows[vertex_at_[i]], first + c) = x[usize(i) * usize(wide_ldl_row) + usize(c)];
        }
    });
    require_finite_result(std::ranges::find(is_finite, 0) == is_finite.end());
}

}  // namespace seamflow
