#include "samples/report/flow_names.h"

#include "engine/measure/smoothed_radius.h"
#include "engine/options/option_names.h"

namespace seamflow {

FlowNames flow_names(const AllOptions& options, const SmoothReport& report)
{
    const StepFilter filter = filter_of(options);
    FlowNames names{.laplacian = name_of(options.laplacian),
                    .flow = option_name(options.flow),
                    .filter = option_name(filter.kind),
                    .order = filter.order,
                    .is_plain = filter.is_plain(),
                    .rescale = option_name(options.motion.rescale),
                    .approach = option_name(report.convergence.approach)};
    if (!report.noise && !report.steps.empty())
        names.radius = smoothed_radius(report.time_step, static_cast<int>(report.steps.size()), filter);
    return names;
}

}  // namespace seamflow
