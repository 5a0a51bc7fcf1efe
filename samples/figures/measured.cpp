#include "samples/figures/measured.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace seamflow {

std::string symbol_of(Laplacian laplacian)
{
    return std::string(traits_of(laplacian).symbol);
}

double quantity(const Table& table, Laplacian laplacian, std::string_view conditions, int step, Quantity what)
{
    const Row* row = table.find(laplacian, conditions, step);
    return row != nullptr ? what(*row) : std::nan("");
}

std::vector<Measured> last_step(const Table& table, const std::vector<Laplacian>& laplacians,
                                std::string_view conditions, Quantity what)
{
    std::vector<Measured> values;
    for (const Laplacian laplacian : laplacians)
        values.push_back({symbol_of(laplacian), quantity(table, laplacian, conditions, table.steps, what)});
    return values;
}

std::string listed(const std::vector<Measured>& values)
{
    std::string text;
    for (const Measured& one : values)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", one.name,
                            std::isnan(one.value) ? "none" : fmt::format("{:.3g}", one.value));
    return text;
}

bool at_most(const std::vector<Measured>& values, double limit)
{
    return std::all_of(values.begin(), values.end(), [&](const Measured& one) { return one.value <= limit; });
}

}  // namespace seamflow
