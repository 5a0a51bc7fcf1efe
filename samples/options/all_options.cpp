#include "samples/options/all_options.h"

#include "engine/options/option_rules.h"

namespace seamflow {

namespace {

std::string_view whole_mesh(const AllOptions& options)
{
    return options.keep_edges ? "<keep_edges>" : options.smooth_rims ? "<boundary smooth>" : "<denoise>";
}

/// Edges that are to stay whatever they are may be those of steps, unless these are named.
RemoveNoise remove_noise(const AllOptions& options)
{
    RemoveNoise method{.rounding = options.rounded};
    if (options.keep_edges) {
        method.edge_angle = *options.keep_edges;
        if (method.rounding.kind == Rounding::Kind::Found)
            method.rounding.kind = Rounding::Kind::Never;
    }
    return method;
}

}  // namespace

DenoiseOptions denoise_options_of(const AllOptions& options)
{
    DenoiseOptions own{.steps = options.steps,
                       .motion = options.motion,
                       .threads = options.resources.threads,
                       .measures = options.report.measures};
    const SmoothingAmount amount{options.time_step, options.time_step_edges, options.radius};
    if (options.smooth_rims)
        own.method = SmoothRims{amount};
    else if (options.denoise)
        own.method = remove_noise(options);
    else
        own.method = SmoothBetweenEdges{options.keep_edges.value(), amount};
    return own;
}

FillText filling(const AllOptions& options)
{
    return [&options](std::string_view text, std::string_view other) {
        constexpr std::string_view place = "{whole}";
        std::string own(text);
        for (std::size_t at = own.find(place); at != std::string::npos; at = own.find(place))
            own.replace(at, place.size(), whole_mesh(options));
        return fill_in(options, own, other);
    };
}

}  // namespace seamflow
