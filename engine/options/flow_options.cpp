#include "engine/options/flow_options.h"

#include <algorithm>

namespace seamflow {

bool predicts(const FlowOptions& options)
{
    return options.interface.conditions == Conditions::AdaptedRobin &&
           options.interface.transmission == Transmission::Predicted && !options.interface.p &&
           options.interface.p_rule == PRule::Paper && options.interface.p_edge == PEdge::Automatic;
}

bool is_plain_flow(const FlowOptions& options)
{
    return options.flow == FlowEquation::MeanCurvature && filter_of(options).is_plain() && !attaches(options.motion);
}

ScaledLaplacian laplacian_of(const FlowOptions& options)
{
    return {options.laplacian, options.uniform_edge};
}

StepFilter filter_of(const FlowOptions& options)
{
    return filter_of(options, options.accuracy.approach, options.accuracy.tolerance);
}

StepFilter filter_of(const FlowOptions& options, Approach approach, std::optional<double> tolerance)
{
    // A smaller tolerance was asked for: the filter must be as exact. Tolerances that are chosen are not smaller.
    constexpr double smallest_by_choice = 1e-4;
    StepFilter filter{.kind = options.filter, .order = options.order.value_or(orders_of(options.filter).first)};
    // Undecomposed steps are exact, so that the filter must not spoil them.
    constexpr double of_undecomposed = 1e-6;
    if (tolerance && *tolerance < smallest_by_choice)
        filter.tolerance = std::max(*tolerance, 1e-12);
    else if (approach == Approach::Undecomposed)
        filter.tolerance = of_undecomposed;
    return filter;
}

bool has_tangential_derivative(Conditions conditions)
{
    return conditions == Conditions::AdaptedVentcell || conditions == Conditions::Ventcell;
}

bool is_classical(Conditions conditions)
{
    return conditions == Conditions::Robin || conditions == Conditions::Ventcell;
}

FlowOptions FlowOptions::plain()
{
    FlowOptions options;
    options.accuracy.approach = Approach::Sweep;
    options.interface.sweep = Sweep::Fixed;
    options.interface.transmission = Transmission::Derivative;
    options.interface.p_edge = PEdge::Minimum;
    return options;
}

}  // namespace seamflow
