#include "samples/report/flow_names.h"

#include "engine/measure/smoothed_radius.h"
#include "engine/options/option_names.h"

namespace seamflow {

FlowNames flow_names(const AllOptions& options, int steps)
{
    const StepFilter filter = filter_of(options);
    FlowNames names{.laplacian = name_of(options.laplacian),
                    .flow = option_name(options.flow),
                    .filter = option_name(filter.kind),
                    .order = filter.order,
                    .is_plain = filter.is_plain(),
                    .rescale = option_name(options.motion.rescale)};
    if (!options.denoise && steps > 0)
        names.radius = smoothed_radius(options.time_step, steps, filter);
    return names;
}

}  // namespace seamflow
