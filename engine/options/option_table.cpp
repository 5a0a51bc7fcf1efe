#include "engine/options/option_table.h"

#include <vector>

namespace seamflow {

std::span<const OptionTraits> all_options()
{
    static const std::vector<OptionTraits> list = [] {
        std::vector<OptionTraits> rows;
        const FlowOptions defaults;
        for_each_option(defaults, [&](const OptionTraits& row) { rows.push_back(row); });
        return rows;
    }();
    return list;
}

std::string_view first_set(const FlowOptions& options, unsigned concerns)
{
    const FlowOptions defaults;
    std::string_view found;
    const auto look = [&](const auto& row, const auto& by_default) {
        if (found.empty() && (row.concerns & concerns) != 0 && *row.value != *by_default.value)
            found = row.field;
    };
    std::apply(
        [&](const auto&... row) {
            std::apply([&](const auto&... by_default) { (look(row, by_default), ...); }, option_table(defaults));
        },
        option_table(options));
    return found;
}

}  // namespace seamflow
