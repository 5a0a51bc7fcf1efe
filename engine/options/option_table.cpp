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
    std::string_view found;
    for_each_option(options, FlowOptions{}, [&](const auto& row, const auto& by_default) {
        if (found.empty() && (row.concerns & concerns) != 0 && *row.value != *by_default.value)
            found = row.field;
    });
    return found;
}

}  // namespace seamflow
