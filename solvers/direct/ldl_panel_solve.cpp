#include <algorithm>
#include <type_traits>

#include "solvers/direct/ldl_panel.h"

namespace seamflow {

namespace {

/// The number of columns that are solved for at once.
constexpr Index columns_at_once = 4;

/// One row of right-hand sides.
/// @param Width of a register, in double-precision numbers. @param Length of the row.
template <class Number, Index Width, Index Length>
struct Row : SimdBlock<Number, Width, Length> {
    Row() = default;
    [[gnu::always_inline]] explicit Row(const Number* x) { this->load_from(x); }
    [[gnu::always_inline]] void subtract(Number factor, const Row& row) { this->add_product(-factor, row); }
    [[gnu::always_inline]] void divide(Number divisor)
    {
        for (auto& numbers : this->registers)
            numbers /= divisor;
    }
    [[gnu::always_inline]] void store_to(Number* x) const
    {
        for (Index p = 0; p < Row::n_registers; ++p)
            store(this->registers[p], x + p * Row::lanes_of_register);
    }
};

/// Eliminates columns that depend on each other, from which all contributions of earlier ones have been subtracted.
/// @param Columns 1 to 4: processors predict loops with such a known number of iterations.
template <Index Width, Index Length, Index Columns, class Number>
[[gnu::always_inline]] inline void eliminate_columns(const LdlPanel<Number>& panel, Index first, Number* x)
{
    using Row = Row<Number, Width, Length>;
    const std::size_t width = usize(panel.width);
    const auto n_rows = static_cast<Index>(panel.rows.size());
    const auto row_of = [&](Index m) { return x + usize(Length) * usize(panel.rows[m]); };
    Number* own = row_of(first);
    const Number* row = panel.values + usize(first) * (width + 1);
    Row known[Columns];
    for (Index i = 0; i < Columns; ++i, row += width) {
        known[i] = Row(own + Length * i);
        for (Index c = 0; c < i; ++c)
            known[i].subtract(row[c], known[c]);
        known[i].store_to(own + Length * i);
    }
    for (Index m = first + Columns; m < n_rows; ++m, row += width) {
        Number* target = row_of(m);
        Row sum(target);
        for (Index c = 0; c < Columns; ++c)
            sum.subtract(row[c], known[c]);
        sum.store_to(target);
    }
}

/// Solves for columns that depend on each other and on later ones.
/// @param Columns 1 to 4.
template <Index Width, Index Length, Index Columns, class Number>
[[gnu::always_inline]] inline void substitute_columns(const LdlPanel<Number>& panel, Index first, Number* x)
{
    using Row = Row<Number, Width, Length>;
    const std::size_t width = usize(panel.width);
    const auto n_rows = static_cast<Index>(panel.rows.size());
    const auto row_of = [&](Index m) { return x + usize(Length) * usize(panel.rows[m]); };
    Number* own = row_of(first);
    const Number* top = panel.values + usize(first) * (width + 1);
    Row sums[Columns];
    for (Index c = 0; c < Columns; ++c) {
        sums[c] = Row(own + Length * c);
        sums[c].divide(top[usize(c) * (width + 1)]);
    }
    const Number* row = top + usize(Columns) * width;
    for (Index m = first + Columns; m < n_rows; ++m, row += width) {
        const Row known(row_of(m));
        for (Index c = 0; c < Columns; ++c)
            sums[c].subtract(row[c], known);
    }
    for (Index i = Columns; i-- > 0;) {
        for (Index c = 0; c < i; ++c)
            sums[c].subtract(top[usize(i) * width + usize(c)], sums[i]);
        sums[i].store_to(own + Length * i);
    }
}

/// Calls use(n), with n from 1 to 4 as a compile-time constant.
template <class Use>
[[gnu::always_inline]] inline void with_known(Index n, Use use)
{
    if (n == 1)
        use(std::integral_constant<Index, 1>());
    else if (n == 2)
        use(std::integral_constant<Index, 2>());
    else if (n == 3)
        use(std::integral_constant<Index, 3>());
    else
        use(std::integral_constant<Index, 4>());
}

/// The work of forward_substitute_panel, for one width of registers.
template <Index Length>
struct EliminatePanel {
    template <Index Width, class Number>
    void operator()(SimdWidth<Width>, const LdlPanel<Number>& panel, Number* x) const
    {
        for (Index first = 0; first < panel.width; first += columns_at_once)
            with_known(std::min(columns_at_once, panel.width - first),
                       [&](auto n) { eliminate_columns<Width, Length, n>(panel, first, x); });
    }
};

/// The work of back_substitute_panel, for one width of registers.
template <Index Length>
struct SubstitutePanel {
    template <Index Width, class Number>
    void operator()(SimdWidth<Width>, const LdlPanel<Number>& panel, Number* x) const
    {
        for (Index end = panel.width; end > 0;) {
            const Index n_columns = std::min(columns_at_once, end);
            end -= n_columns;
            with_known(n_columns, [&](auto n) { substitute_columns<Width, Length, n>(panel, end, x); });
        }
    }
};

}  // namespace

template <Index Length, class Number>
void forward_substitute_panel(const LdlPanel<Number>& panel, Number* x)
{
    with_simd_width(register_width(), EliminatePanel<Length>(), panel, x);
}

template <Index Length, class Number>
void back_substitute_panel(const LdlPanel<Number>& panel, Number* x)
{
    with_simd_width(register_width(), SubstitutePanel<Length>(), panel, x);
}

template void forward_substitute_panel<ldl_row>(const LdlPanel<float>&, float*);
template void forward_substitute_panel<ldl_row>(const LdlPanel<double>&, double*);
template void forward_substitute_panel<wide_ldl_row>(const LdlPanel<float>&, float*);
template void forward_substitute_panel<wide_ldl_row>(const LdlPanel<double>&, double*);
template void back_substitute_panel<ldl_row>(const LdlPanel<float>&, float*);
template void back_substitute_panel<ldl_row>(const LdlPanel<double>&, double*);
template void back_substitute_panel<wide_ldl_row>(const LdlPanel<float>&, float*);
template void back_substitute_panel<wide_ldl_row>(const LdlPanel<double>&, double*);

}  // namespace seamflow
