#include "engine/options/valid_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/options/motion_rules.h"
#include "engine/options/option_limits.h"
#include "engine/options/option_names.h"
#include "engine/options/option_rules.h"
#include "engine/options/option_table.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// Checks all numbers that have limits of their own, except time_step if another field gives the amount.
/// @throws OptionError
void require_limits(const FlowOptions& options)
{
    for_each_option(options, [&](const auto& row) {
        const bool is_open = row.field == "time_step" && (options.radius || options.time_step_edges);
        if constexpr (requires { require_within(row, *row.value); })
            if (!row.limits.text.empty() && !is_open)
                require_within(row, *row.value);
    });
}

/// @throws OptionError if the filter does not have this order.
void require_valid_filter(const FlowOptions& options)
{
    const auto [least, most] = orders_of(options.filter);
    const int order = filter_of(options).order;
    if (order < least || order > most)
        refuse(fmt::format("<order> is {}, but must be {} to {} with the filter {}", order, least, most,
                           option_name(options.filter)));
}

}  // namespace

void require_valid(const FlowOptions& options)
{
    require_limits(options);
    require_valid_vertex_values(options.motion);
    require_valid_filter(options);
    require_compatible(options, changed_options(options));
    if (!options.motion.feature_edges.empty())
        refuse("<feature_edges> names edges to keep, which flows do not: see denoise(), which smooths between edges");
    const auto negative =
        std::find_if(options.cut.labels.begin(), options.cut.labels.end(), [](Index label) { return label < 0; });
    if (negative != options.cut.labels.end())
        throw InputError(fmt::format("the label of face {} is {}, but labels must be at least 0",
                                     negative - options.cut.labels.begin(), *negative));
}

}  // namespace seamflow
