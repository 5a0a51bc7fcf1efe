#include <algorithm>
#include <type_traits>

#include "solvers/direct/ldl_panel.h"

namespace seamflow {

namespace {

/// Columns that are solved for at once.
constexpr Index columns_at_once = 4;

/// One row of three right-hand sides.
struct Row {
    SimdVector<double, 2> xy{};
    double z = 0.0;

    Row() = default;
    explicit Row(const double* x)
        : xy{x[0], x[1]}
        , z(x[2])
    {
    }
    void subtract(double factor, const Row& row)
    {
        xy -= factor * row.xy;
        z -= factor * row.z;
    }
    void divide(double divisor)
    {
        xy /= divisor;
        z /= divisor;
    }
    void store(double* x) const
    {
        x[0] = xy[0];
        x[1] = xy[1];
        x[2] = z;
    }
};

double* row_of(double* x, Index unknown)
{
    return x + 3 * at(unknown);
}

/// Eliminates columns that depend on each other, from which all that earlier ones contribute has been taken away.
/// @param Columns 1 to 4: in loops of so many known turns processors do not lose their way.
template <Index Columns>
void eliminate_columns(const LdlPanel& panel, Index first, double* x)
{
    const std::size_t width = at(panel.width);
    const auto n_rows = static_cast<Index>(panel.rows.size());
    double* own = row_of(x, panel.rows[first]);
    const double* row = panel.values + at(first) * (width + 1);
    Row known[Columns];
    for (Index i = 0; i < Columns; ++i, row += width) {
        known[i] = Row(own + 3 * i);
        for (Index c = 0; c < i; ++c)
            known[i].subtract(row[c], known[c]);
        known[i].store(own + 3 * i);
    }
    for (Index m = first + Columns; m < n_rows; ++m, row += width) {
        double* target = row_of(x, panel.rows[m]);
        Row sum(target);
        for (Index c = 0; c < Columns; ++c)
            sum.subtract(row[c], known[c]);
        sum.store(target);
    }
}

/// Solves for columns that depend on each other and on later ones.
/// @param Columns 1 to 4.
template <Index Columns>
void substitute_columns(const LdlPanel& panel, Index first, double* x)
{
    const std::size_t width = at(panel.width);
    const auto n_rows = static_cast<Index>(panel.rows.size());
    double* own = row_of(x, panel.rows[first]);
    const double* top = panel.values + at(first) * (width + 1);
    Row sums[Columns];
    for (Index c = 0; c < Columns; ++c) {
        sums[c] = Row(own + 3 * c);
        sums[c].divide(top[at(c) * (width + 1)]);
    }
    const double* row = top + at(Columns) * width;
    for (Index m = first + Columns; m < n_rows; ++m, row += width) {
        const Row known(row_of(x, panel.rows[m]));
        for (Index c = 0; c < Columns; ++c)
            sums[c].subtract(row[c], known);
    }
    for (Index i = Columns; i-- > 0;) {
        for (Index c = 0; c < i; ++c)
            sums[c].subtract(top[at(i) * width + at(c)], sums[i]);
        sums[i].store(own + 3 * i);
    }
}

/// use(n), n from 1 to 4 being known to the compiler.
template <class Use>
void with_known(Index n, Use use)
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

}  // namespace

void forward_substitute_panel(const LdlPanel& panel, double* x)
{
    for (Index first = 0; first < panel.width; first += columns_at_once)
        with_known(std::min(columns_at_once, panel.width - first),
                   [&](auto n) { eliminate_columns<n>(panel, first, x); });
}

void back_substitute_panel(const LdlPanel& panel, double* x)
{
    for (Index end = panel.width; end > 0;) {
        const Index n_columns = std::min(columns_at_once, end);
        end -= n_columns;
        with_known(n_columns, [&](auto n) { substitute_columns<n>(panel, end, x); });
    }
}

}  // namespace seamflow
