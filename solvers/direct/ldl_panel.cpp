#include "solvers/direct/ldl_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace seamflow {

namespace {

/// The columns that are factorised at once, and the columns of an earlier panel that are used at once.
constexpr Index group = 8;
constexpr Index chunk = 64;
/// The most target rows that are computed at once.
constexpr Index most_lanes = 16;

/// Some rows of a panel times D Lᵀ of as many other rows as there are lanes.
/// @param rows the first entry of the first row. @param width the distance between rows. @param factors D Lᵀ: for each
/// of n columns, the numbers of all lanes. @param use(r, sums) takes the sums of row r.
template <Index Rows, class Vector, class Number, class Use>
[[gnu::always_inline]] inline void multiply(const Number* rows, std::size_t width, const Number* factors, Index n,
                                            Use&& use)
{
    Vector sums[Rows];
    for (Index c = 0; c < n; ++c) {
        Vector factor;
        factor.load_from(factors + c * Vector::lanes);
        for (Index r = 0; r < Rows; ++r)
            sums[r].add_product(rows[usize(r) * width + usize(c)], factor);
    }
    for (Index r = 0; r < Rows; ++r)
        use(r, sums[r]);
}

/// The sums of these rows fill at most eight registers.
template <class Vector>
constexpr Index rows_at_once = Vector::n_registers > 2 ? 2 : 4;

/// Consecutive rows of a panel whose products with other rows are computed, each in a lane of its own; other lanes do
/// not change.
struct Targets {
    /// The first target row, and the number of target rows.
    Index first;
    Index n;
    /// Per target row: its lane.
    std::array<Index, usize(most_lanes)> lane;
};

/// The n rows from `first` on, in lanes 0, 1, 2 and so on.
Targets consecutive_targets(Index first, Index n)
{
    Targets targets{first, n, {}};
    std::iota(targets.lane.begin(), targets.lane.end(), 0);
    return targets;
}

/// The rows from the first target row on, times D Lᵀ of the target rows, over the panel's columns [first, last).
/// @param use(i, sums) takes the sums of the i-th row; called more than once per row if there are many columns.
template <class Vector, class Number, class Use>
[[gnu::always_inline]] inline void multiply_all(const LdlPanel<Number>& panel, Index first, Index last,
                                                const Targets& targets, Use&& use)
{
    const std::size_t width = usize(panel.width);
    const Number* rows = panel.values + usize(targets.first) * width;
    const Index n_rows = static_cast<Index>(panel.rows.size()) - targets.first;
    std::array<Number, usize(chunk * Vector::lanes)> factors;
    for (Index begin = first; begin < last; begin += chunk) {
        const Index size = std::min(chunk, last - begin);
        if (targets.n < Vector::lanes)
            std::fill_n(factors.begin(), usize(size * Vector::lanes), Number{0});
        for (Index c = 0; c < size; ++c) {
            const Number pivot = panel.values[usize(begin + c) * (width + 1)];
            for (Index t = 0; t < targets.n; ++t)
                factors[c * Vector::lanes + targets.lane[t]] = pivot * rows[usize(t) * width + usize(begin + c)];
        }
        constexpr Index at_once = rows_at_once<Vector>;
        Index i = 0;
        for (; i + at_once <= n_rows; i += at_once)
            multiply<at_once, Vector>(rows + usize(i) * width + usize(begin), width, factors.data(), size,
                                      [&](Index r, const Vector& sums) { use(i + r, sums); });
        for (; i < n_rows; ++i)
            multiply<1, Vector>(rows + usize(i) * width + usize(begin), width, factors.data(), size,
                                [&](Index, const Vector& sums) { use(i, sums); });
    }
}

/// How many of some ascending columns, from the first on, lie within `width` consecutive columns.
[[gnu::always_inline]] inline Index count_neighbours(const Index* columns, Index n, Index width)
{
    Index count = 1;
    while (count < n && count < width && columns[count] - columns[0] < width)
        ++count;
    return count;
}

/// Updates columns that lie within as many consecutive columns as there are lanes. From the columns in between, 0 is
/// subtracted.
template <class Vector, class Number>
[[gnu::always_inline]] inline void update_columns(const LdlPanel<Number>& earlier, Index row_index, Index n,
                                                  const Index* target_rows, const LdlPanel<Number>& later)
{
    const std::size_t width = usize(later.width);
    const Index begin = std::max(Index{0}, std::min(target_rows[0], later.width - Vector::lanes));
    Targets targets{row_index, n, {}};
    for (Index t = 0; t < n; ++t)
        targets.lane[t] = target_rows[t] - begin;
    Number* columns = later.values + begin;
    if (later.width >= Vector::lanes)
        multiply_all<Vector>(earlier, 0, earlier.width, targets, [&](Index i, const Vector& sums) {
            sums.subtract_from(columns + usize(target_rows[i]) * width);
        });
    else
        multiply_all<Vector>(earlier, 0, earlier.width, targets, [&](Index i, const Vector& sums) {
            sums.subtract_from(columns + usize(target_rows[i]) * width, later.width);
        });
}

/// Subtracts the contribution of the panel's columns [first, last) from the n columns after them.
template <class Vector, class Number>
[[gnu::always_inline]] inline void subtract_columns(const LdlPanel<Number>& panel, Index first, Index last, Index n)
{
    if (first == last || n == 0)
        return;
    const std::size_t width = usize(panel.width);
    Number* target = panel.values + usize(last) * (width + 1);
    const Targets targets = consecutive_targets(last, n);
    if (n == Vector::lanes)
        multiply_all<Vector>(panel, first, last, targets,
                             [&](Index i, const Vector& sums) { sums.subtract_from(target + usize(i) * width); });
    else
        multiply_all<Vector>(panel, first, last, targets,
                             [&](Index i, const Vector& sums) { sums.subtract_from(target + usize(i) * width, n); });
}

/// Factorises columns that depend only on each other.
/// @param Columns 1 to 4.
/// @returns whether their pivots are finite and not 0.
template <Index Columns, class Number>
[[gnu::always_inline]] inline bool factorise_columns(const LdlPanel<Number>& panel, Index first)
{
    const std::size_t width = usize(panel.width);
    Number* top = panel.values + usize(first) * (width + 1);
    Number inverse[Columns];
    Number factor[Columns][Columns];
    Number* row = top;
    bool sound = true;
    for (Index i = 0; i < Columns; ++i, row += width) {
        for (Index c = 0; c < i; ++c) {
            for (Index k = 0; k < c; ++k)
                row[c] -= row[k] * factor[c][k];
        }
        for (Index c = 0; c < i; ++c) {
            factor[i][c] = row[c] * inverse[c];
            row[i] -= row[c] * factor[i][c];
            row[c] = factor[i][c];
        }
        sound &= row[i] != Number{0} && std::isfinite(row[i]);
        inverse[i] = Number{1} / row[i];
    }
    const auto n_rows = static_cast<Index>(panel.rows.size());
    for (Index m = first + Columns; m < n_rows; ++m, row += width) {
        Number scaled[Columns];
        for (Index c = 0; c < Columns; ++c) {
            scaled[c] = row[c];
            for (Index k = 0; k < c; ++k)
                scaled[c] -= scaled[k] * factor[c][k];
        }
        for (Index c = 0; c < Columns; ++c)
            row[c] = scaled[c] * inverse[c];
    }
    return sound;
}

/// Factorises n columns, n from 0 to 4.
template <class Number>
[[gnu::always_inline]] inline bool factorise_columns(const LdlPanel<Number>& panel, Index first, Index n)
{
    switch (n) {
    case 0:
        return true;
    case 1:
        return factorise_columns<1>(panel, first);
    case 2:
        return factorise_columns<2>(panel, first);
    case 3:
        return factorise_columns<3>(panel, first);
    default:
        return factorise_columns<4>(panel, first);
    }
}

/// The work of subtract_update, for one width of registers.
struct SubtractUpdate {
    template <Index Width, class Number>
    void operator()(SimdWidth<Width>, const LdlPanel<Number>& earlier, Index row_index, Index n_columns,
                    const Index* target_rows, const LdlPanel<Number>& later) const
    {
        for (Index t = 0, n = 0; t < n_columns; t += n) {
            const auto among = [&](Index width) { return count_neighbours(target_rows + t, n_columns - t, width); };
            // Sixteen lanes are used if they take two registers at most.
            if constexpr (Width * sizeof(double) >= 8 * sizeof(Number))
                if (n_columns - t > 8 && (n = among(16)) > 8) {
                    update_columns<SimdBlock<Number, Width, 16>>(earlier, row_index + t, n, target_rows + t, later);
                    continue;
                }
            if (n = among(8); n > 4)
                update_columns<SimdBlock<Number, Width, 8>>(earlier, row_index + t, n, target_rows + t, later);
            else {
                n = among(4);
                update_columns<SimdBlock<Number, Width, 4>>(earlier, row_index + t, n, target_rows + t, later);
            }
        }
    }
};

/// The work of factorise_panel, for one width of registers. Columns are factorised in groups, and a group in two
/// halves.
struct FactorisePanel {
    template <Index Width, class Number>
    bool operator()(SimdWidth<Width>, const LdlPanel<Number>& panel) const
    {
        using Four = SimdBlock<Number, Width, 4>;
        using Eight = SimdBlock<Number, Width, 8>;
        for (Index first = 0; first < panel.width; first += group) {
            const Index n = std::min(group, panel.width - first);
            const Index half = std::min(group / 2, n);
            if (n > half)
                subtract_columns<Eight>(panel, 0, first, n);
            else
                subtract_columns<Four>(panel, 0, first, n);
            if (!factorise_columns(panel, first, half))
                return false;
            subtract_columns<Four>(panel, first, first + half, n - half);
            if (!factorise_columns(panel, first + half, n - half))
                return false;
        }
        return true;
    }
};

}  // namespace

template <class Number>
void subtract_update(const LdlPanel<Number>& earlier, Index row_index, Index n_columns, const Index* target_rows,
                     const LdlPanel<Number>& later, Index width)
{
    with_simd_width(width, SubtractUpdate(), earlier, row_index, n_columns, target_rows, later);
}

template <class Number>
bool factorise_panel(const LdlPanel<Number>& panel, Index width)
{
    return with_simd_width(width, FactorisePanel(), panel);
}

template void subtract_update(const LdlPanel<float>&, Index, Index, const Index*, const LdlPanel<float>&, Index);
template void subtract_update(const LdlPanel<double>&, Index, Index, const Index*, const LdlPanel<double>&, Index);
template bool factorise_panel(const LdlPanel<float>&, Index);
template bool factorise_panel(const LdlPanel<double>&, Index);

}  // namespace seamflow
